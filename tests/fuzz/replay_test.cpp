// The attack on the readers in small: the corpus, and a few thousand files that are nearly right. Under the sanitizers
// it finds what they find; for more there is libFuzzer (README.md).

#include <catch2/catch.hpp>
#include <chrono>

#include "calibrate/base/machine.h"
#include "tests/calibrate/folder.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/readers.h"

using namespace pastefit;
using namespace pastefit::fuzz;

TEST_CASE("Whatever a file holds, it is read or refused with faults", "[fuzz]") {
  constexpr double kEach_s = 3;  // for each reader, at most, once the fewest are through
  constexpr int kFewest = 20, kMost = 1500;
  for (const Reader& reader : readers()) {
    std::vector<std::string> texts;
    for (const auto& file : corpus_of(reader)) texts.push_back(test::content(file));
    REQUIRE_FALSE(texts.empty());
    const auto words = describe(texts);
    const auto attack = [&](const std::string& text) {
      const double start_s = thread_seconds();
      try {
        reader.read(text);
      } catch (const std::exception& error) {
        FAIL(reader.name << ": " << error.what() << "\n" << text);
      }
      const double taken_s = thread_seconds() - start_s;
      INFO(reader.name << "\n" << text);
      CHECK(taken_s < 5);  // one second, but under the sanitizers
    };
    const auto start = std::chrono::steady_clock::now();
    for (const std::string& text : texts) attack(text);
    const auto in_time = [&] {
      return std::chrono::steady_clock::now() - start < std::chrono::duration<double>(kEach_s);
    };
    int number = 0;
    while (number < kFewest || (number < kMost && in_time())) {
      const auto seed = static_cast<std::uint64_t>(number++);
      attack(mutated(texts[seed % texts.size()], texts, words, RandomStream(seed, reader.name)));
    }
  }
}
