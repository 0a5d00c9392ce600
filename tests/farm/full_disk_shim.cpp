// Preloaded into a coordinator: a disk that is full while a file is there. FJORD_FULL_FLAG names
// the file, FJORD_FULL_DIR the folder below which nothing more can be written; where the file says
// "blobs", the journal still can.
#include <dlfcn.h>
#include <errno.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

bool Full(bool journal) {
  std::FILE* flag = std::fopen(std::getenv("FJORD_FULL_FLAG"), "r");
  if (flag == nullptr) return false;
  char text[16] = {};
  const bool blobs_only =
      std::fgets(text, sizeof text, flag) != nullptr && std::strncmp(text, "blobs", 5) == 0;
  std::fclose(flag);
  return !(journal && blobs_only);
}

bool FullFor(int file) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  const char* folder = std::getenv("FJORD_FULL_DIR");
  if (std::strncmp(path, folder, std::strlen(folder)) != 0) return false;
  return Full(std::strstr(path, "journal.sqlite") != nullptr);
}

template <typename Function>
Function Real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define FJORD_SHIM(name, parameters, arguments)                  \
  extern "C" ssize_t name parameters {                           \
    static const auto real = Real<ssize_t(*) parameters>(#name); \
    if (!FullFor(file)) return real arguments;                   \
    errno = ENOSPC;                                              \
    return -1;                                                   \
  }

FJORD_SHIM(write, (int file, const void* bytes, size_t size), (file, bytes, size))
FJORD_SHIM(pwrite, (int file, const void* bytes, size_t size, off_t at), (file, bytes, size, at))
FJORD_SHIM(pwrite64, (int file, const void* bytes, size_t size, off64_t at),
           (file, bytes, size, at))

extern "C" int statvfs(const char* path, struct statvfs* disk) {
  static const auto real = Real<int (*)(const char*, struct statvfs*)>("statvfs");
  const int answer = real(path, disk);
  if (answer == 0 && Full(false)) disk->f_bavail = 0;
  return answer;
}
