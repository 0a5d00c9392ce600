// What the primitives are put together from: checks of their parameters, quads, even steps. Private
// to this folder.
#pragma once

#include <algorithm>
#include <string>

#include "engine/base/result.h"
#include "engine/geometry/mesh.h"

namespace fjord::primitive {

// As many as a shape file may hold (engine/formats/limits.h).
inline constexpr uint64_t kMostPoints = 16'000'000;
inline constexpr double kLongest = 1e12;

inline bool IsLength(double x) { return x > 0 && x <= kLongest; }

inline Error BadLength(const std::string& what) {
  return Invalid(what + " must be greater than 0 and at most 1e12");
}

inline Result<> CheckCount(const char* name, uint32_t count, uint32_t least) {
  if (count >= least) return Ok{};
  return Invalid(std::string(name) + " must be at least " + std::to_string(least) + ", not " +
                 std::to_string(count));
}

inline Result<> CheckPoints(uint64_t a, uint64_t b) {
  if (a <= kMostPoints && b <= kMostPoints && a * b <= kMostPoints) return Ok{};
  return MakeError(ErrorCode::kLimit, std::to_string(a) + " x " + std::to_string(b) +
                                          " points are more than 16,000,000; use fewer");
}

// Corners counter-clockwise from outside; the diagonal alternates so that no direction is
// preferred.
inline void AddQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool other_diagonal,
                    Mesh* mesh) {
  const auto add = [mesh](uint32_t i, uint32_t j, uint32_t k) {
    Triangle t = {i, j, k};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    mesh->AddFace(t);
  };
  if (other_diagonal) {
    add(a, b, d);
    add(b, c, d);
  } else {
    add(a, b, c);
    add(a, c, d);
  }
}

// from + (to - from) i / n, exactly `from` and `to` at the ends.
inline double Between(double from, double to, uint32_t i, uint32_t n) {
  return i == n ? to : from + (to - from) * i / n;
}

}  // namespace fjord::primitive
