// Pictures whose names differ in a number: shot_1.png, shot_2.png ... shot_12.png. The number may
// stand anywhere and have leading zeros or none; everything else of the name, in whatever script,
// is compared byte by byte. Pictures without a number are one sequence in the order of their names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/frame_set.h"

namespace fjord {

class PictureSequence {
 public:
  struct Entry {
    std::string file;
    uint64_t number = 0;
  };

  // In the order of their numbers. `pattern` has # for each digit's place.
  PictureSequence(std::string pattern, bool numbered, std::vector<Entry> entries);

  // "shot_#.png (12)", "title.png".
  std::string Describe() const;
  // "a.1.png and a.01.png have one number"; empty: all differ.
  std::string Doubled() const;
  // "frames 4,7-9 are missing": of `chosen`, or, where nothing is chosen, between the first and the
  // last; empty: none.
  std::string Missing(const FrameSet& chosen, size_t most_named) const;
  // Those of `chosen`; all where nothing is chosen.
  std::vector<std::string> Files(const FrameSet& chosen) const;

 private:
  std::string pattern_;
  bool numbered_;
  std::vector<Entry> entries_;
};

std::vector<PictureSequence> SequencesOf(std::vector<std::string> files);

}  // namespace fjord
