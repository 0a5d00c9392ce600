// The path grammar of the scene language, shared by tracks, --set and messages:
//   objects[coast].fractal.H      an entry of a list by its name ...
//   objects[1].key[2].frame       ... or by its number, from 1
//   camera.eye                    a whole vector
// Text only; route.h finds what a path means in a scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace fjord {

struct PathPiece {
  std::string field;
  std::string selector;  // empty: none
  friend bool operator==(const PathPiece&, const PathPiece&) = default;
};

struct FieldPath {
  std::vector<PathPiece> pieces;
  friend bool operator==(const FieldPath&, const FieldPath&) = default;
};

// kInvalid, naming the column from 1 where the path goes wrong.
Result<FieldPath> ParseFieldPath(std::string_view text);
std::string PrintFieldPath(const FieldPath& path);

// Letters, digits, - and _; not empty, at most limits::kNameBytes: what names of objects and lights
// are made of.
bool IsSceneName(std::string_view name);

// What the names of pictures may begin with, and a scene may be named: characters of any script and
// blanks, without / and control characters, not beginning with a dot, at most limits::kNameBytes.
bool IsPictureStem(std::string_view name);

}  // namespace fjord
