#include "calibrate/base/machine.h"

#include <dlfcn.h>
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif
#include <malloc.h>
#include <sched.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "core/target.h"

namespace pastefit {

std::string machine_type() {
  utsname name{};
  std::string out = uname(&name) == 0 ? name.machine : "unknown";
#if PASTEFIT_X86
  if (__builtin_cpu_supports("fma")) out += " fma";
#endif
#if defined(__EMSCRIPTEN__)
  return out + " emscripten " + std::to_string(__EMSCRIPTEN_major__) + "." + std::to_string(__EMSCRIPTEN_minor__) +
         "." + std::to_string(__EMSCRIPTEN_tiny__);
#elif defined(__GLIBC__)
  return out + " glibc " + gnu_get_libc_version();
#else
  return out + " another C library";
#endif
}

int processors() {
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // too many for `cpu_set_t`
}

double memory_available_bytes() {
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    double kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  }
  return std::numeric_limits<double>::infinity();
}

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // [bytes]; smaller blocks are not mapped individually
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

namespace fs = std::filesystem;

namespace {

/// `share/pastefit` beside a parent folder of this code's file: in a shared library, e.g. for Python, the program is a
/// foreign one.
std::vector<fs::path> beside_this_code() {
  std::vector<fs::path> found;
  Dl_info code;
  if (dladdr(reinterpret_cast<const void*>(&data_folders), &code) == 0 || !code.dli_fname) return found;
  const fs::path file = code.dli_fname;
  std::error_code error;
  if (file.is_absolute())
    for (fs::path above = file.parent_path(); above.has_relative_path(); above = above.parent_path())
      if (fs::is_directory(above / "share" / "pastefit", error)) found.push_back(above / "share" / "pastefit");
  return found;
}

}  // namespace

std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  if (const char* data = std::getenv("PASTEFIT_DATA_DIR"); data && *data) folders.emplace_back(data);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back((program.parent_path() / ".." / "share" / "pastefit").lexically_normal());
  for (fs::path& folder : beside_this_code()) folders.push_back(std::move(folder));
  for (const std::string_view folder : {PASTEFIT_SOURCE_DATA_DIR, PASTEFIT_INSTALL_DATA_DIR})
    if (!folder.empty()) folders.emplace_back(folder);
  return folders;
}

}  // namespace pastefit
