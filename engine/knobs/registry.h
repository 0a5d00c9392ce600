// A registry: the list of entries of one kind (fractal methods, texture stages, ...). Every kind
// uses this one mechanism: an entry is one file that defines a function returning its Info, and one
// line in the registry's list. Append only: a name keeps its meaning, an entry its place.
//
// Immutable once it has been read; safe to share between threads.
#pragma once

#include <utility>

#include "engine/base/check.h"
#include "engine/knobs/knob_table.h"

namespace fjord {

// What all kinds of entry have. An Info of a kind derives from it and adds what the kind does.
struct EntryInfo {
  std::string_view name;
  uint32_t version = 1;  // in the frame key of every frame that uses the entry (D5)
  std::string_view summary;
  KnobTable knobs;
};

template <typename Info>
class Registry {
 public:
  explicit Registry(std::vector<Info> entries) : entries_(std::move(entries)) {}

  std::span<const Info> entries() const { return entries_; }
  // Null where there is no such entry.
  const Info* Find(std::string_view name) const {
    for (const Info& entry : entries_) {
      if (entry.name == name) return &entry;
    }
    return nullptr;
  }
  // For tests, before anything else has looked at the registry: pointers to entries end here.
  void Extend(Info entry) {
    FJORD_CHECK(Find(entry.name) == nullptr, entry.name);
    entries_.push_back(std::move(entry));
  }

 private:
  std::vector<Info> entries_;
};

}  // namespace fjord
