#include "server/disk_watch.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace fjord::server {
namespace {

constexpr std::chrono::seconds kLookEvery{1};
constexpr uint64_t kMargin = uint64_t{1} << 20;  // bytes that must be free beside what is wanted

}  // namespace

DiskWatch::DiskWatch(std::string folder, std::function<void(const std::string&)> tell)
    : folder_(std::move(folder)), tell_(std::move(tell)), thread_([this] { Run(); }) {}

DiskWatch::~DiskWatch() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void DiskWatch::Full(uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = full_ ? std::max(wanted_, bytes) : bytes;
    if (std::exchange(full_, true)) return;
  }
  wake_.notify_all();
  tell_("the disk of the coordinator's data folder " + folder_ +
        " is full: what is made waits until there is room");
}

bool DiskWatch::HasRoomFor(uint64_t bytes) const {
  struct statvfs disk {};
  if (statvfs(folder_.c_str(), &disk) != 0) return false;
  return uint64_t{disk.f_bavail} * disk.f_frsize >= bytes + kMargin;
}

void DiskWatch::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || full_; });
    wake_.wait_for(lock, kLookEvery, [this] { return stop_; });
    if (stop_) return;
    const uint64_t wanted = wanted_;
    lock.unlock();
    const bool over = HasRoomFor(wanted);
    lock.lock();
    if (!over || wanted != wanted_) continue;
    full_ = false;
    lock.unlock();
    tell_("");
    lock.lock();
  }
}

}  // namespace fjord::server
