#include "calibrate/base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>

namespace pastefit {

namespace {

bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// A rename is durable only after syncing the folder.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

Faults unwritable(const std::filesystem::path& file, int error) {
  return {{file.string(), std::string("cannot be written: ") + std::strerror(error),
           "a folder that can be written, on a disk with free space"}};
}

/// Creates a new file beside this one. Names that already exist, possibly links of another user, are skipped, never
/// followed or overwritten.
int open_beside(const std::filesystem::path& file, std::filesystem::path& beside) {
  constexpr int most_names = 100;
  const std::string begin = file.string() + "." + std::to_string(::getpid());
  for (int i = 0; i < most_names; ++i) {
    beside = begin + (i == 0 ? "" : "-" + std::to_string(i)) + ".part";
    const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace

std::string kind_of_special_file(const std::filesystem::path& path) {
  using Type = std::filesystem::file_type;
  static const std::map<Type, std::string> kinds{{Type::directory, "a folder"}, {Type::symlink, "a symbolic link"},
                                                 {Type::block, "a device"},     {Type::character, "a device"},
                                                 {Type::fifo, "a FIFO"},        {Type::socket, "a socket"}};
  std::error_code error;
  const auto found = kinds.find(std::filesystem::symlink_status(path, error).type());
  return found == kinds.end() ? "" : found->second;
}

Faults write_atomically(const std::filesystem::path& file, std::string_view content) {
  if (const std::string special = kind_of_special_file(file); !special.empty())
    return {{file.string(), "is " + special + ", and only a regular file is replaced", "choose another name"}};
  std::filesystem::path beside;
  const int descriptor = open_beside(file, beside);
  bool written = descriptor >= 0 && write_all(descriptor, content) && ::fsync(descriptor) == 0;
  int error = errno;
  if (descriptor >= 0 && ::close(descriptor) != 0 && written) {
    written = false;
    error = errno;
  }
  if (written && std::rename(beside.c_str(), file.c_str()) != 0) {
    written = false;
    error = errno;
  }
  if (!written) {
    if (descriptor >= 0) ::unlink(beside.c_str());
    return unwritable(file, error);
  }
  sync_folder(file.has_parent_path() ? file.parent_path() : ".");
  return {};
}

Faults probe_beside(const std::filesystem::path& file, std::size_t bytes) {
  std::filesystem::path beside;
  const int descriptor = open_beside(file, beside);
  const bool written = descriptor >= 0 && write_all(descriptor, std::string(bytes, '.'));
  const int error = errno;
  if (descriptor >= 0) {
    ::close(descriptor);
    ::unlink(beside.c_str());
  }
  return written ? Faults{} : unwritable(file, error);
}

std::shared_ptr<void> locked(const std::filesystem::path& file) {
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return nullptr;
    std::shared_ptr<void> lock(nullptr, [descriptor](void*) { ::close(descriptor); });
    ::flock(descriptor, LOCK_EX);
    // The previous holder may have replaced the file.
    struct stat held {
    }, there{};
    const bool same = ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &there) == 0 &&
                      held.st_ino == there.st_ino && held.st_dev == there.st_dev;
    if (same) return lock;
  }
}

}  // namespace pastefit
