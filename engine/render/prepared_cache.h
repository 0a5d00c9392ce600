// Prepared objects kept between tiles, frames and threads: a still island under a moving camera is
// prepared once. Methods that are made whole live here too.
//
// Ownership: what Get returns is shared and immutable; it outlives its place in the cache.
// Threads: any number. One makes an object, others that want it wait.
//
// Invariants
// P1 What is kept takes at most most_bytes by PreparedFractal::Bytes; the least recently used goes
//    first. What is larger alone is made and handed out, but not kept.
// P2 A key says all that the object depends on, so an object from here has the bits of a new one.
// P3 A failure is not kept, and is its maker's alone: those who waited try for themselves.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "engine/base/digest.h"
#include "engine/base/result.h"
#include "engine/fractal/method.h"

namespace fjord {

struct PreparedObject {
  std::shared_ptr<const PreparedFractal> prepared;
  // What `prepared` was made from; settings.method is empty for a shape without a fractal.
  std::shared_ptr<const CoarseShape> shape;
  MethodSettings settings;

  size_t Bytes() const;
};

class PreparedCache {
 public:
  explicit PreparedCache(size_t most_bytes) : most_bytes_(most_bytes) {}

  // The process's own.
  static PreparedCache& Shared();
  static constexpr size_t kSharedBytes = size_t{1} << 30;

  // The object of that key, made by `make` where it is not there.
  using Make = std::function<Result<PreparedObject>()>;
  Result<std::shared_ptr<const PreparedObject>> Get(const Digest& key, const Make& make);

  struct Stats {
    uint64_t made = 0;
    uint64_t found = 0;
    size_t waiting = 0;  // threads, now
    size_t objects = 0;  // kept
    size_t bytes = 0;
  };
  Stats stats() const;

 private:
  struct Entry {
    Digest key;
    std::shared_ptr<const PreparedObject> object;
    size_t bytes = 0;
  };
  using Object = std::shared_ptr<const PreparedObject>;
  Object Find(const Digest& key);
  void Keep(const Digest& key, const Object& object);

  const size_t most_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable made_;
  // Guarded by mutex_.
  std::list<Entry> entries_;  // most recently used first
  std::map<Digest, std::list<Entry>::iterator> places_;
  // Being made, with what was made, for those who wait; null while it is made and after a failure.
  struct Making {
    Object object;
    bool ended = false;
  };
  std::map<Digest, std::shared_ptr<Making>> making_;
  Stats stats_;
};

}  // namespace fjord
