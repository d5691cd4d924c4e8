#include <catch2/catch.hpp>
#include <sstream>

#include "calibrate/base/text.h"

using namespace pastefit;

TEST_CASE("long lines are broken between words, and short ones left as they are") {
  CHECK(wrapped("one two\n\nthree\n", 5) == "one\n  two\n\nthree\n");
  CHECK(wrapped("  a table   of   columns", 80) == "  a table   of   columns");
  const std::string sentence = "4 of 8 packings sheared off, which the standards reject, and so on and on and on.";
  std::istringstream lines(wrapped(sentence, 30));
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() <= 30);
    all += (all.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
  }
  CHECK(all == sentence);
}

TEST_CASE("a number stays beside its error and its percent sign") {
  CHECK(wrapped("off by 34.9 +- 6 of 40", 14) == "off by\n  34.9 +- 6 of\n  40");
  CHECK(wrapped("a share of 84 % of all", 14) == "a share of\n  84 % of all");
}

TEST_CASE("what goes on of a table's row stands below its second column") {
  CHECK(wrapped("  --out DIR  a folder for all of it", 26) == "  --out DIR  a folder for\n             all of it");
}

TEST_CASE("a word that is longer than a line stays whole, and letters count, not bytes") {
  CHECK(wrapped("see /a/very/long/path/to/it now", 10) == "see\n  /a/very/long/path/to/it\n  now");
  CHECK(wrapped("\xC3\xA4\xC3\xB6\xC3\xBC \xC3\x9F", 5) == "\xC3\xA4\xC3\xB6\xC3\xBC \xC3\x9F");
}
