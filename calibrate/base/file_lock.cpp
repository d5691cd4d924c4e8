#include "calibrate/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pastefit {

FileLock::FileLock(const std::filesystem::path& file) {
  for (;;) {
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0) return;
    ::flock(descriptor_, LOCK_EX);
    // Whoever held it may have put another file in its place.
    struct stat held {
    }, there{};
    const bool same = ::fstat(descriptor_, &held) == 0 && ::stat(file.c_str(), &there) == 0 &&
                      held.st_ino == there.st_ino && held.st_dev == there.st_dev;
    if (same) return;
    ::close(descriptor_);
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace pastefit
