#include "calibrate/base/machine.h"

#include <gnu/libc-version.h>
#include <malloc.h>
#include <sched.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdlib>  // says whether it is the GNU C library
#include <fstream>
#include <limits>
#include <thread>

#ifdef __GLIBC__
#endif

namespace pastefit {

std::string machine_type() {
  utsname name{};
  std::string out = uname(&name) == 0 ? name.machine : "unknown";
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma")) out += " fma";
#endif
  return out + " glibc " + gnu_get_libc_version();
}

int processors() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // more than the set has room for
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
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // [bytes]; blocks below it are not mapped one by one
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace pastefit
