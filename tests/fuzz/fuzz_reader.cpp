// libFuzzer, which has the main program, attacks one reader of files: PASTEFIT_FUZZ_READER is its name.

#include <algorithm>
#include <cstdint>

#include "tests/fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto reader =
      *std::ranges::find(pastefit::fuzz::readers(), PASTEFIT_FUZZ_READER, &pastefit::fuzz::Reader::name);
  reader.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
