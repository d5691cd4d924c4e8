#include "calibrate/card/machine.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

namespace pastefit {

std::string machine_type() {
  utsname name{};
  std::string out = uname(&name) == 0 ? name.machine : "unknown";
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma")) out += " fma";
#endif
  return out + " glibc " + gnu_get_libc_version();
}

}  // namespace pastefit
