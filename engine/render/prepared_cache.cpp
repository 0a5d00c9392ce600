#include "engine/render/prepared_cache.h"

#include <utility>

namespace fjord {

size_t PreparedObject::Bytes() const {
  return sizeof(*this) + prepared->Bytes() + (shape ? shape->Bytes() : 0);
}

PreparedCache& PreparedCache::Shared() {
  static PreparedCache cache(kSharedBytes);
  return cache;
}

PreparedCache::Object PreparedCache::Find(const Digest& key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, place->second);
  return entries_.front().object;
}

void PreparedCache::Keep(const Digest& key, const Object& object) {
  const size_t bytes = object->Bytes();
  if (bytes > most_bytes_) return;
  entries_.push_front({key, object, bytes});
  places_[key] = entries_.begin();
  stats_.bytes += bytes;
  while (stats_.bytes > most_bytes_) {
    stats_.bytes -= entries_.back().bytes;
    places_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

Result<std::shared_ptr<const PreparedObject>> PreparedCache::Get(const Digest& key,
                                                                 const Make& make) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    if (Object object = Find(key)) {
      ++stats_.found;
      return object;
    }
    const auto found = making_.find(key);
    if (found == making_.end()) break;
    const std::shared_ptr<const Making> other = found->second;
    ++stats_.waiting;
    made_.wait(lock, [&] { return other->ended; });
    --stats_.waiting;
    if (other->object) {
      ++stats_.found;
      return other->object;
    }
  }
  const auto mine = std::make_shared<Making>();
  making_[key] = mine;
  lock.unlock();
  Result<PreparedObject> made = make();
  lock.lock();
  making_.erase(key);
  mine->ended = true;
  made_.notify_all();
  if (!made) return made.error();
  ++stats_.made;
  mine->object = std::make_shared<const PreparedObject>(std::move(*made));
  Keep(key, mine->object);
  return mine->object;
}

PreparedCache::Stats PreparedCache::stats() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stats stats = stats_;
  stats.objects = entries_.size();
  return stats;
}

}  // namespace fjord
