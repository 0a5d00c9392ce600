// Bounds of what shape files may hold. Each has its own error message (kLimit), given before the
// memory is taken; a count in a file is believed only as far as there are bytes to back it.
#pragma once

#include <cstddef>

namespace fjord::limits {

inline constexpr size_t kFileBytes = size_t{1} << 30;
inline constexpr size_t kVertices = 16'000'000;  // of the mesh and all curves together
inline constexpr size_t kIndices = 64'000'000;   // corners of all faces
inline constexpr size_t kCurves = 4'000'000;
inline constexpr size_t kLineBytes = 16u << 20;  // a face or path of a million corners on one line
inline constexpr size_t kHeaderLineBytes = 64u << 10;  // .ply header, .par
inline constexpr size_t kParBytes = 1u << 20;
inline constexpr size_t kDepth = 64;  // elements of a .svg within each other, also by `use`
inline constexpr size_t kXmlItems = 16'000'000;    // elements and attributes of a .svg
inline constexpr size_t kUsed = 1'000'000;         // elements of a .svg that `use` draws again
inline constexpr size_t kStyleRules = 10'000;      // of a .svg, that hide, move or paint something
inline constexpr size_t kStyleLooks = 10'000'000;  // times that a rule is held against an element
// Anything larger cannot be meant: squares of it still fit a double with room to spare.
inline constexpr double kCoordinate = 1e15;

}  // namespace fjord::limits
