#include "calibrate/study/schemas.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "calibrate/card/card.h"
#include "calibrate/exports/application.h"
#include "calibrate/laboratory/measurement.h"
#include "calibrate/laboratory/test.h"
#include "tests/calibrate/folder.h"

namespace pastefit {
namespace {

/// Parts that fit on a line stand on one.
std::string in_lines(const nlohmann::ordered_json& part, std::size_t indent = 0) {
  constexpr std::size_t width = 130;
  const std::string line = part.dump();
  if (!part.is_structured() || line.size() + indent < width) return line;
  std::string inner;
  for (const auto& [key, value] : part.items())
    inner += (inner.empty() ? "\n" : ",\n") + std::string(indent + 1, ' ') +
             (part.is_object() ? "\"" + key + "\": " : "") + in_lines(value, indent + 1);
  inner += "\n" + std::string(indent, ' ');
  return part.is_object() ? "{" + inner + "}" : "[" + inner + "]";
}

}  // namespace

// PASTEFIT_WRITE_SCHEMAS=1 test_calibrate "the schemas*" writes them anew, data/schema/make_tables.py then the tables.
TEST_CASE("the schemas of data/schema are those of the descriptions that the readers use") {
  const std::pair<const char*, nlohmann::ordered_json> schemas[]{
      {"apparatus", apparatus_schema()}, {"application", application_schema()},
      {"card", card_schema()},           {"lab", lab_schema()},
      {"laws", laws_schema()},           {"study", study_schema()}};
  for (const auto& [name, schema] : schemas) {
    const std::string file = std::string(PASTEFIT_SOURCE_DIR "/data/schema/") + name + ".schema.json";
    const std::string text = in_lines(schema) + "\n";
    if (std::getenv("PASTEFIT_WRITE_SCHEMAS")) std::ofstream(file) << text;
    INFO(file);
    CHECK(test::content(file) == text);
  }
}

TEST_CASE("every reading that laboratories take has its words for the schemas") {
  for (const ReadingKind& kind : all_reading_kinds()) {
    INFO(kind.name);
    CHECK((kind.key.empty() || !meaning_of_reading(kind.key).empty()));
  }
}

}  // namespace pastefit
