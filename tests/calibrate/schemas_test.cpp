#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "calibrate/card/card.h"
#include "tests/calibrate/folder.h"

namespace pastefit {

// PASTEFIT_WRITE_SCHEMAS=1 test_calibrate "the schemas*" writes them anew, data/schema/make_tables.py then the tables.
TEST_CASE("the schemas of data/schema are those of the descriptions that the readers use") {
  const std::pair<const char*, nlohmann::ordered_json> schemas[]{{"card", card_schema()}};
  for (const auto& [name, schema] : schemas) {
    const std::string file = std::string(PASTEFIT_SOURCE_DIR "/data/schema/") + name + ".schema.json";
    const std::string text = schema.dump(1) + "\n";
    if (std::getenv("PASTEFIT_WRITE_SCHEMAS")) std::ofstream(file) << text;
    INFO(file);
    CHECK(test::content(file) == text);
  }
}

}  // namespace pastefit
