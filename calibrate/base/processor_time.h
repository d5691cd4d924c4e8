#pragma once

#include <ctime>

namespace pastefit {

/// Time that processors have worked [s], by POSIX's clock of the calling thread or of the whole process.
inline double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
inline double thread_seconds() {
  return processor_seconds(CLOCK_THREAD_CPUTIME_ID);
}
inline double process_seconds() {
  return processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace pastefit
