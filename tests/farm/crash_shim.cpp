// Preloaded into a coordinator: kills it (SIGKILL) right after its N-th system call that writes
// something below a folder. FJORD_CRASH_DIR names the folder, FJORD_CRASH_AFTER is N (from 1).
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> g_count{0};

bool Below(const char* path) {
  static const char* const folder = std::getenv("FJORD_CRASH_DIR");
  return folder != nullptr && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool Below(int file) {
  char link[64], path[4096];
  std::strcpy(link, "/proc/self/fd/");
  char digits[16];
  int count = 0, rest = file;
  do {
    digits[count++] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest > 0);
  char* end = link + std::strlen(link);
  while (count > 0) *end++ = digits[--count];
  *end = '\0';
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return Below(path);
}

void Count() {
  static const char* const after = std::getenv("FJORD_CRASH_AFTER");
  static const long limit = after == nullptr ? 0 : std::atol(after);
  if (++g_count == limit) syscall(SYS_kill, syscall(SYS_getpid), SIGKILL);
}

template <typename Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// Each calls the real one, then counts.
#define FJORD_SHIM(result, name, where, parameters, arguments)  \
  extern "C" result name parameters {                           \
    static const auto real = Real<result(*) parameters>(#name); \
    const result answer = real arguments;                       \
    if (answer >= 0 && Below(where)) Count();                   \
    return answer;                                              \
  }

FJORD_SHIM(ssize_t, write, file, (int file, const void* bytes, size_t size), (file, bytes, size))
FJORD_SHIM(ssize_t, pwrite, file, (int file, const void* bytes, size_t size, off_t at),
           (file, bytes, size, at))
FJORD_SHIM(ssize_t, pwrite64, file, (int file, const void* bytes, size_t size, off64_t at),
           (file, bytes, size, at))
FJORD_SHIM(int, fsync, file, (int file), (file))
FJORD_SHIM(int, fdatasync, file, (int file), (file))
FJORD_SHIM(int, syncfs, file, (int file), (file))
FJORD_SHIM(int, ftruncate, file, (int file, off_t size), (file, size))
FJORD_SHIM(int, ftruncate64, file, (int file, off64_t size), (file, size))
FJORD_SHIM(int, rename, to, (const char* from, const char* to), (from, to))
FJORD_SHIM(int, link, to, (const char* from, const char* to), (from, to))
FJORD_SHIM(int, unlink, path, (const char* path), (path))
FJORD_SHIM(int, mkdir, path, (const char* path, mode_t mode), (path, mode))
FJORD_SHIM(int, rmdir, path, (const char* path), (path))
