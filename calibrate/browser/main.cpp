#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "calibrate/base/text.h"

// The data folder as browser/archive.cmake packs it: of each file its path, its length and its bytes.
asm(R"(
  .section .rodata.data,"",@
  .globl pastefit_data_begin
pastefit_data_begin:
  .incbin ")" PASTEFIT_DATA_ARCHIVE R"("
  .size pastefit_data_begin, .-pastefit_data_begin
  .globl pastefit_data_end
pastefit_data_end:
  .byte 0
  .size pastefit_data_end, 1
  .text
)");
extern "C" const char pastefit_data_begin[], pastefit_data_end[];

namespace {

namespace fs = std::filesystem;

void unpack_data(const fs::path& folder) {
  std::string_view rest(pastefit_data_begin, static_cast<std::size_t>(pastefit_data_end - pastefit_data_begin));
  while (!rest.empty()) {
    const fs::path file = folder / std::string(pastefit::next_line(rest));
    const auto length = static_cast<std::size_t>(std::stoul(std::string(pastefit::next_line(rest))));
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(rest.data(), static_cast<std::streamsize>(length));
    rest.remove_prefix(length);
  }
}

}  // namespace

/// The module's files are in memory: the data where the program looks for them, and a folder for those of a study.
int main() {
  unpack_data("/share/pastefit");
  ::setenv("PASTEFIT_DATA_DIR", "/share/pastefit", 1);
  fs::create_directories("/study");
  fs::current_path("/study");
}
