#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/card/card.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/study.h"
#include "calibrate/verify/case.h"
#include "tests/calibrate/files.h"

namespace pastefit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Folder;

const fs::path kData = PASTEFIT_SOURCE_DIR "/data";

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// Where a number stands, without the places in lists: a key's range is the same for all of them.
std::string key_of(const std::string& pointer) {
  std::string key;
  for (const char letter : pointer)
    if (letter < '0' || letter > '9') key += letter;
  return key;
}

/// Replaces each number of the shipped files by one far out of any range, one at a time, each key once; `read` says
/// whether it takes the document. Returns the keys that were taken, and counts those that were tried.
template <class Read>
std::string taken_by(const fs::path& folder, Read read, std::size_t& tried) {
  std::string taken;
  std::set<std::string> seen;
  for (const fs::path& file : files_in(folder)) {
    const json document = json::parse(std::ifstream(file), nullptr, true, true);
    REQUIRE(read(document));
    const json numbers = document.flatten();
    for (const auto& [pointer, value] : numbers.items()) {
      const bool only_told = pointer.find("/conditions/") != std::string::npos;  // made anew with every card, not read
      if (only_told || !value.is_number() || !seen.insert(key_of(pointer)).second) continue;
      ++tried;
      for (const double number : {1e300, -1e300, 1e16}) {
        json spoiled = document;
        spoiled[json::json_pointer(pointer)] = number;
        if (read(spoiled)) taken += file.filename().string() + pointer + " = " + std::to_string(number) + "\n";
      }
    }
  }
  return taken;
}

TEST_CASE("every number of a file has a range, and what lies far beyond it is refused wherever it stands") {
  const Folder desk;
  fs::create_directory_symlink(kData / "lab", desk.path() / "lab");
  fs::create_directory_symlink(kData / "apparatus", desk.path() / "apparatus");
  fs::create_directory(desk.path() / "studies");
  std::size_t tried = 0;
  const auto lab = [&](const json& document) { return lab_from_json(document, kData / "lab").ok(); };
  CHECK(taken_by(kData / "lab", lab, tried) == "");
  CHECK(taken_by(
            kData / "apparatus", [](const json& document) { return apparatus_from_json(document).ok(); }, tried) == "");
  const auto study = [&](const json& document) {
    return read_study(desk.write("studies/study.json", document.dump())).ok();
  };
  CHECK(taken_by(kData / "studies", study, tried) == "");
  const auto card = [](const json& document) { return card_from_json(document).ok(); };
  CHECK(taken_by(kData / "cards", card, tried) == "");
  CHECK(tried > 200);
}

}  // namespace
}  // namespace pastefit
