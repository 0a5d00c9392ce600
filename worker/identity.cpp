#include "worker/identity.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <random>
#include <sstream>

#include "engine/base/digest.h"

namespace fjord::worker {
namespace {

constexpr int kMostWorkers = 1'000;  // on one machine
constexpr size_t kMostEnded = 15;    // sessions remembered of one worker

std::string Folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::string folder = (runtime != nullptr && *runtime != '\0' ? std::string(runtime) : "/tmp") +
                       "/fjord-workers-" + std::to_string(getuid());
  mkdir(folder.c_str(), 0700);
  return folder;
}

// The file, locked for as long as it is open; -1: another holds it.
int OpenLocked(const std::string& path) {
  while (true) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file < 0) return -1;
    struct stat held {
    }, named{};
    if (flock(file, LOCK_EX | LOCK_NB) != 0 || fstat(file, &held) != 0) {
      close(file);
      return -1;
    }
    if (stat(path.c_str(), &named) == 0 && named.st_ino == held.st_ino) return file;
    close(file);  // whoever held it before has removed it
  }
}

}  // namespace

std::string TakeWorkerId() {
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  const std::string folder = Folder();
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

std::string NewSessionName() {
  std::random_device device;
  char text[33];
  std::snprintf(text, sizeof text, "%08x%08x%08x%08x", device(), device(), device(), device());
  return text;
}

std::unique_ptr<SessionNote> SessionNote::Take(const std::string& id, const std::string& server,
                                               const std::string& session) {
  std::string path = Folder() + "/" + Sha256Of(id + "\n" + server).Hex().substr(0, 32);
  const int file = OpenLocked(path);
  if (file < 0) return nullptr;
  std::unique_ptr<SessionNote> note(new SessionNote(std::move(path), file));
  char bytes[4096];
  const ssize_t size = pread(file, bytes, sizeof bytes, 0);
  std::istringstream lines(std::string(bytes, size > 0 ? static_cast<size_t>(size) : 0));
  for (std::string line; std::getline(lines, line);) {
    if (line.size() == session.size()) note->ended_.push_back(line);
  }
  if (note->ended_.size() > kMostEnded) {
    note->ended_.erase(note->ended_.begin(), note->ended_.end() - kMostEnded);
  }
  std::string all;
  for (const std::string& ended : note->ended_) all += ended + "\n";
  all += session + "\n";
  const bool written = ftruncate(file, 0) == 0 &&
                       pwrite(file, all.data(), all.size(), 0) == static_cast<ssize_t>(all.size());
  return written ? std::move(note) : nullptr;
}

SessionNote::~SessionNote() { close(file_); }

void SessionNote::Forget() { unlink(path_.c_str()); }

}  // namespace fjord::worker
