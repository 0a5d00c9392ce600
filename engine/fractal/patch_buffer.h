// Uninitialised storage on cache lines, for plain types: what the tables of a patch are made of.
//
// Owned by one thread at a time. Entries beyond what their owner counts are garbage, and
// kPatchPadding of them may be read and written, so that whole vectors can be.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace fjord {

inline constexpr size_t kPatchPadding = 64;

template <typename T>
class PatchBuffer {
 public:
  T* data() const { return data_.get(); }
  T& operator[](size_t i) const { return data_.get()[i]; }
  size_t bytes() const { return capacity_ * sizeof(T); }

  // Room for `count` and the padding; the first `keep` entries stay.
  void Reserve(size_t count, size_t keep) {
    if (count + kPatchPadding <= capacity_) return;
    const size_t capacity = count + count / 2 + 2 * kPatchPadding;
    std::unique_ptr<T[], Free> grown(
        static_cast<T*>(::operator new (capacity * sizeof(T), std::align_val_t{64})));
    if (keep > 0) std::memcpy(static_cast<void*>(grown.get()), data_.get(), keep * sizeof(T));
    data_ = std::move(grown);
    capacity_ = capacity;
  }

 private:
  struct Free {
    void operator()(T* p) const { ::operator delete (static_cast<void*>(p), std::align_val_t{64}); }
  };
  std::unique_ptr<T[], Free> data_;
  size_t capacity_ = 0;
};

}  // namespace fjord
