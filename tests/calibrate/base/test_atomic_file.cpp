#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "calibrate/base/atomic_file.h"
#include "tests/calibrate/folder.h"

using namespace pastefit;

TEST_CASE("a file is replaced whole, and stays as it was when that fails") {
  const test::Folder temporary;
  const std::filesystem::path& folder = temporary.path();
  CHECK(write_atomically(folder / "card.json", "old").empty());
  CHECK(write_atomically(folder / "card.json", "new").empty());
  CHECK(test::content(folder / "card.json") == "new");
  std::filesystem::create_directories(folder / "taken" / "by a folder");
  CHECK_FALSE(write_atomically(folder / "taken", "x").empty());
  CHECK_FALSE(write_atomically(folder / "missing" / "card.json", "x").empty());
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  CHECK(files == 2);  // nothing is left beside them
}
