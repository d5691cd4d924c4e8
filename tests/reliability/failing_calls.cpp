// A library to be loaded before all others (LD_PRELOAD): one call of the program fails, the n-th of its kind.
//
//   PASTEFIT_FAIL="KIND N"   the kind and the number, from 1; 0: none fails
//   PASTEFIT_CALLS=FILE      where the numbers of calls are written when the program ends, "KIND COUNT" a line
//
// Kinds: `write` (also at a place, in parts, or to change a length) to a regular file, no space is left; `sync` of a
// file or a folder, the disk fails; `rename`, likewise; `thread`, none can be started; `memory` asked for by SQLite,
// there is none; `exit`, this library never comes to its end. Model: the failing file system and memory of SQLite's own
// tests (sqlite.org/testing.html, 3.1 to 3.3).

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_realloc(void*, std::size_t);
}

namespace {

enum Kind { write_, sync_, rename_, thread_, memory_, exit_, kinds };
constexpr std::array<const char*, kinds> kNames{"write", "sync", "rename", "thread", "memory", "exit"};

std::array<std::atomic<long>, kinds> calls;
long failing[kinds];                // which one fails; 0: none
std::uintptr_t sqlite[2] = {0, 0};  // where its code begins and ends
std::atomic<bool> over = false;

bool fails(Kind kind) {
  return ++calls[kind] == failing[kind];
}

bool is_regular(int file) {
  struct stat about;
  return fstat(file, &about) == 0 && S_ISREG(about.st_mode);
}

int look_for_sqlite(dl_phdr_info* library, std::size_t, void*) {
  if (!std::strstr(library->dlpi_name, "libsqlite3")) return 0;
  for (int k = 0; k < library->dlpi_phnum; ++k) {
    const auto& part = library->dlpi_phdr[k];
    if (part.p_type != PT_LOAD || !(part.p_flags & PF_X)) continue;
    sqlite[0] = library->dlpi_addr + part.p_vaddr;
    sqlite[1] = sqlite[0] + part.p_memsz;
  }
  return 1;
}

__attribute__((constructor)) void begin() {
  dl_iterate_phdr(look_for_sqlite, nullptr);
  const char* wish = std::getenv("PASTEFIT_FAIL");
  char name[16];
  long number = 0;
  if (!wish || std::sscanf(wish, "%15s %ld", name, &number) != 2) return;
  for (int kind = 0; kind < kinds; ++kind)
    if (std::strcmp(name, kNames[kind]) == 0) failing[kind] = number;
}

void write_counts() {
  over = true;
  const char* file = std::getenv("PASTEFIT_CALLS");
  if (!file) return;
  if (std::FILE* out = std::fopen(file, "w")) {
    for (int kind = 0; kind < exit_; ++kind) std::fprintf(out, "%s %ld\n", kNames[kind], calls[kind].load());
    std::fclose(out);
  }
}

__attribute__((destructor)) void end() {
  write_counts();
  if (failing[exit_] > 0)
    for (;;) pause();
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// The call of that name behind this library, unless it is the one that fails with `error`.
#define PASS_ON(name, does_fail, error, ...)             \
  static const auto real = next<decltype(&name)>(#name); \
  if (!over && (does_fail)) {                            \
    errno = error;                                       \
    return -1;                                           \
  }                                                      \
  return real(__VA_ARGS__)

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, std::size_t size) {
  PASS_ON(write, is_regular(file) && fails(write_), ENOSPC, file, data, size);
}

ssize_t writev(int file, const iovec* parts, int count) {
  PASS_ON(writev, is_regular(file) && fails(write_), ENOSPC, file, parts, count);
}

ssize_t pwrite(int file, const void* data, std::size_t size, off_t place) {
  PASS_ON(pwrite, is_regular(file) && fails(write_), ENOSPC, file, data, size, place);
}

ssize_t pwrite64(int file, const void* data, std::size_t size, off64_t place) {
  PASS_ON(pwrite64, is_regular(file) && fails(write_), ENOSPC, file, data, size, place);
}

int ftruncate(int file, off_t size) noexcept {
  PASS_ON(ftruncate, fails(write_), ENOSPC, file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
  PASS_ON(ftruncate64, fails(write_), ENOSPC, file, size);
}

int fsync(int file) {
  PASS_ON(fsync, fails(sync_), EIO, file);
}

int fdatasync(int file) {
  PASS_ON(fdatasync, fails(sync_), EIO, file);
}

void _exit(int status) {
  write_counts();
  static const auto real = next<void (*)(int)>("_exit");
  real(status);
  __builtin_unreachable();
}

int rename(const char* from, const char* to) noexcept {
  PASS_ON(rename, fails(rename_), EIO, from, to);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*work)(void*), void* with) noexcept {
  static const auto real = next<decltype(&pthread_create)>("pthread_create");
  return fails(thread_) ? EAGAIN : real(thread, how, work, with);
}

// Only what SQLite asks for itself counts.
#define ASKED_BY_SQLITE \
  (reinterpret_cast<std::uintptr_t>(__builtin_return_address(0)) - sqlite[0] < sqlite[1] - sqlite[0])

void* malloc(std::size_t size) noexcept {
  if (ASKED_BY_SQLITE && fails(memory_)) return nullptr;
  return __libc_malloc(size);
}

void* realloc(void* old, std::size_t size) noexcept {
  if (ASKED_BY_SQLITE && fails(memory_)) return nullptr;
  return __libc_realloc(old, size);
}

}  // extern "C"
