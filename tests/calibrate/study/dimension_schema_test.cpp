#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "calibrate/laboratory/test.h"

namespace pastefit {
namespace {

using nlohmann::json;

json schema(const std::string& name) {
  std::ifstream file(PASTEFIT_SOURCE_DIR "/data/schema/" + name + ".schema.json");
  return json::parse(file);
}

std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys;
  std::istringstream text(path);
  for (std::string key; std::getline(text, key, '.');) keys.push_back(key);
  return keys;
}

/// The schema of the key at the end of these, and that of the object which has it; null if there is none.
struct Found {
  const json* object = nullptr;
  const json* key = nullptr;
};
Found find(const json& object, const std::vector<std::string>& keys, std::size_t first) {
  const auto properties = object.find("properties");
  if (properties == object.end() || !properties->contains(keys[first])) return {};
  const json& inner = properties->at(keys[first]);
  return first + 1 == keys.size() ? Found{&object, &inner} : find(inner, keys, first + 1);
}

/// The forms of an object that have all of these keys; `skipped`: keys above the object.
std::vector<const json*> forms_with(const json& forms, const std::vector<FilePlace>& places, std::size_t skipped) {
  std::vector<const json*> out;
  for (const json& form : forms)
    if (std::ranges::all_of(places, [&](const FilePlace& one) { return find(form, keys_of(one.place), skipped).key; }))
      out.push_back(&form);
  return out;
}

/// Dimensions only: neither objects nor surfaces that belong to the material.
std::vector<FilePlace> dimensions_of(std::string_view kind) {
  std::vector<FilePlace> places = places_in_files(test_of_kind(kind).value());
  std::erase_if(places, [](const FilePlace& one) { return one.meaning.empty(); });
  return places;
}

std::size_t numbers_in(const json& object) {
  std::size_t count = 0;
  for (const json& inner : object.at("properties"))
    count += inner.contains("properties") ? numbers_in(inner) : inner.value("type", json()) == "number";
  return count;
}

}  // namespace

TEST_CASE("the schemas of laboratory and apparatus files say of each dimension what its row says, and have no other") {
  for (const char* name : {"lab", "apparatus"}) {
    const json document = schema(name);
    for (const std::string_view kind : kinds_of_tests()) {
      const std::vector<FilePlace> places = dimensions_of(kind);
      const auto forms = forms_with(document.at("/properties/apparatus/oneOf"_json_pointer), places, 1);
      INFO(name << ": " << kind);
      REQUIRE_FALSE(forms.empty());
      for (const json* form : forms) {
        CHECK(numbers_in(*form) == places.size());
        const bool preset = form->at("properties").contains("preset");
        for (const FilePlace& one : places) {
          const auto [object, key] = find(*form, keys_of(one.place), 1);
          INFO(one.place);
          CHECK(key->at("description") == one.meaning);
          CHECK(key->value("minimum", -1.0) == Approx(one.range.smallest));
          CHECK(key->value("maximum", -1.0) == Approx(one.range.largest));
          const auto needed = object->value("required", std::vector<std::string>{});
          if (!preset) CHECK((std::ranges::count(needed, keys_of(one.place).back()) > 0) == !one.has_default);
        }
      }
    }
  }
}

}  // namespace pastefit
