// Which edges have been met: an open hash table of keys, for edges that come once with each of
// their faces. Keys are 64 bits mixed from the ends' identities; that two edges share one is as
// likely as that their identities do, and costs a line of a wireframe.
//
// Not for sharing between threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/random.h"

namespace fjord {

class EdgeSet {
 public:
  // False: it was there.
  bool Insert(uint32_t place, uint64_t from, uint64_t to) {
    if (2 * (size_ + 1) > slots_.size()) Grow();
    const uint64_t key = Mix64(Mix64(from + place * 0x9e3779b97f4a7c15u) ^ to) | 1;  // 0 is free
    if (!Put(key)) return false;
    ++size_;
    return true;
  }

  void Clear() {
    slots_.clear();
    size_ = 0;
  }

 private:
  bool Put(uint64_t key) {
    const size_t mask = slots_.size() - 1;
    for (size_t at = (key >> 1) & mask;; at = (at + 1) & mask) {
      if (slots_[at] == key) return false;
      if (slots_[at] != 0) continue;
      slots_[at] = key;
      return true;
    }
  }

  void Grow() {
    std::vector<uint64_t> before(slots_.empty() ? 1024 : 2 * slots_.size());
    before.swap(slots_);
    for (const uint64_t key : before) {
      if (key != 0) Put(key);
    }
  }

  std::vector<uint64_t> slots_;  // a power of two
  size_t size_ = 0;
};

}  // namespace fjord
