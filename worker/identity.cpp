#include "worker/identity.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

namespace fjord::worker {
namespace {

constexpr int kMostWorkers = 1'000;  // on one machine

}  // namespace

std::string TakeWorkerId() {
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::string folder =
      (runtime != nullptr && *runtime != '\0' ? std::string(runtime) : "/tmp") + "/fjord-workers-" +
      std::to_string(getuid());
  mkdir(folder.c_str(), 0700);
  for (int number = 1; number <= kMostWorkers; ++number) {
    const std::string path = folder + "/" + std::to_string(number);
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) break;
    if (flock(file, LOCK_EX | LOCK_NB) == 0)
      return std::string(host) + "-" + std::to_string(number);
    close(file);
  }
  return std::string(host) + "-p" + std::to_string(getpid());
}

}  // namespace fjord::worker
