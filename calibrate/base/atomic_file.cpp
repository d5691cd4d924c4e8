#include "calibrate/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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

/// A rename is on the disk only when its folder is.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string kind_of_special_file(const std::filesystem::path& path) {
  std::error_code error;
  switch (std::filesystem::symlink_status(path, error).type()) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::symlink:
      return "a symbolic link";
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character:
      return "a device";
    case std::filesystem::file_type::fifo:
      return "a FIFO";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "";
  }
}

Faults write_atomically(const std::filesystem::path& file, std::string_view content) {
  if (const std::string special = kind_of_special_file(file); !special.empty())
    return {{file.string(), "is " + special + ", and only a regular file is replaced", "choose another name"}};
  const auto beside = std::filesystem::path(file.string() + "." + std::to_string(::getpid()) + ".part");
  const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
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
    return {{file.string(), std::string("cannot be written: ") + std::strerror(error),
             "a folder that can be written, on a disk with free space"}};
  }
  sync_folder(file.has_parent_path() ? file.parent_path() : ".");
  return {};
}

}  // namespace pastefit
