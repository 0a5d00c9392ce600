// Halving one segment of a line: what the methods "curve" and "coast" share. When a segment is
// split, where its midpoint goes, and how far anything below it can reach. Pure functions of the
// segment, the input edge's frame and the settings (M1); plain values, safe in any thread.
#pragma once

#include <array>

#include "engine/fractal/method.h"

namespace fjord {

inline constexpr uint32_t kMaxLineLevel = 40;

struct LineVertex {
  Vec3 position{0};
  Vec3 direction{0};  // unit, or shorter where what it was made from nearly cancels (Softened)
  Identity id;
  float stretch = 1;
  double eye_distance2 = 0;
  uint32_t level = 0;
  Weights place{0};  // in its input edge
};

// From a to b along the chain: what is on its right-hand side is outside.
struct LineSegment {
  LineVertex a;
  LineVertex b;
  double rest2 = 0;    // squared length in the rest pose: a quarter of the parent's, exactly
  uint64_t place = 0;  // covers place / 2^level .. (place + 1) / 2^level of its input edge

  uint32_t level() const { return a.level > b.level ? a.level : b.level; }
};

// Of an input edge: the plane its normals lie in, unit, and its own normal, softened.
struct LineFrame {
  Vec3 plane{0, 0, 1};
  Vec3 normal{0};
};

// The same point of the segment's middle twice: unmoved, and moved by offset * vertex.direction.
struct LineHalf {
  LineVertex vertex;
  Vec3 middle{0};
  double draw = 0;    // the Gaussian: the same in every frame
  double offset = 0;  // of the draw's sign
};

class LineRules {
 public:
  // Resolved, checked settings. kInvalid where the law or the split cannot be followed.
  static Result<LineRules> Make(const FractalSettings& settings);

  const FractalSettings& settings() const { return settings_; }

  // Squared length over squared threshold, kept apart so that the comparison is exact.
  struct Size {
    double length2;
    double threshold2;
    bool Splits() const { return length2 > threshold2; }
    bool IsLarge() const { return length2 > 256 * threshold2; }
  };
  // Size of the segment in the units of the split rule; past max_level nothing splits.
  Size Measure(const LineSegment& segment) const;

  LineHalf Halve(const LineSegment& segment, const LineFrame& frame, const Size& size) const;
  LineSegment First(const LineSegment& segment, const LineVertex& middle) const;
  LineSegment Second(const LineSegment& segment, const LineVertex& middle) const;

  // How far from the straight segment anything made of it can lie, rounding included.
  double Reach(const LineSegment& segment) const;

  // Levels that a segment's subtree can still have.
  uint32_t RemainingLevels(const LineSegment& segment) const;

 private:
  explicit LineRules(const FractalSettings& settings) : settings_(settings) {}

  Vec3 Direction(const LineSegment& segment, const LineFrame& frame, Identity id) const;
  double Offset(const LineSegment& segment, double draw, double stretch) const;

  FractalSettings settings_;
  double affine_ = 0;   // sigma A c(H)
  double similar_ = 0;  // r
  double bound_ = 0;    // of the Gaussian
  double decay_ = 0;    // 2^-H
  std::array<double, kMaxLineLevel> shih_{};
};

// d at unit length, or d / kLeastSquare where it is shorter than that: a continuous function of d,
// so that directions pass through 0 instead of flipping.
Vec3 Softened(const Vec3& d);

// Right-hand normal of a segment in the plane, softened; 0 where it has no length.
Vec3 RightNormal(const Vec3& along, const Vec3& plane);

StreamVertex ToStream(const LineVertex& vertex);

// Length now over length at rest, each vertex the mean of its edges'; 1 where there is no rest
// length. At most 1e6.
float StretchOf(double sum, uint32_t edges);

}  // namespace fjord
