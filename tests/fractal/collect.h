// Shared by the tests of fractal methods: coarse shapes, a sink that keeps everything, and digests.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/digest.h"
#include "engine/fractal/method.h"
#include "engine/fractal/midpoint_knobs.h"
#include "engine/fractal/registry.h"
#include "tests/fractal/choices.h"

namespace fjord::test {

// A corner of a leaf: everything that must agree bit for bit, and the level-free order key first.
struct Corner {
  uint64_t id = 0;
  std::array<uint64_t, 6> bits{};  // position, direction
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

inline Corner MakeCorner(uint64_t id, const Vec3& p, const Vec3& d) {
  const auto bits = [](double x) { return std::bit_cast<uint64_t>(x == 0 ? 0.0 : x); };
  return {id, {bits(p.x), bits(p.y), bits(p.z), bits(d.x), bits(d.y), bits(d.z)}};
}

// A triangle (turned so that its smallest corner leads) or a segment.
using Leaf = std::vector<Corner>;

inline Leaf Led(Leaf leaf) {
  if (leaf.size() == 3) {
    std::rotate(leaf.begin(), std::min_element(leaf.begin(), leaf.end()), leaf.end());
  }
  return leaf;
}

// Keeps all leaves. `wanted`, where set, is asked for every subtree.
class CollectSink : public StreamSink {
 public:
  bool Wants(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) override {
    ++asked;
    return !wanted || wanted(a, b, c, reach);
  }
  void Take(const StreamBatch& batch) override {
    ++batches;
    const auto corner = [&](uint32_t i) {
      const StreamVertex& v = batch.vertices[i];
      points.push_back(v.position);
      return MakeCorner(v.id, v.position, v.direction);
    };
    for (const Triangle& t : batch.triangles) {
      leaves.push_back(Led({corner(t[0]), corner(t[1]), corner(t[2])}));
    }
    for (const auto& s : batch.segments) {
      leaves.push_back({corner(s[0]), corner(s[1])});
    }
  }

  std::function<bool(const Vec3&, const Vec3&, const Vec3&, const StreamReach&)> wanted;
  std::vector<Leaf> leaves;
  std::vector<Vec3> points;
  size_t asked = 0;
  size_t batches = 0;
};

inline std::vector<Leaf> StreamedLeaves(const PreparedFractal& fractal, size_t patch_hint = 2048) {
  CollectSink sink;
  for (size_t root = 0; root < fractal.RootCount(); ++root) {
    fractal.Stream(root, sink, patch_hint);
  }
  std::sort(sink.leaves.begin(), sink.leaves.end());
  return sink.leaves;
}

inline std::vector<Leaf> WeldedLeaves(const WeldedShape& shape) {
  std::vector<Leaf> leaves;
  const auto corner = [&](size_t i) {
    return MakeCorner(shape.identity[i].lo, shape.mesh.points[i], shape.direction[i]);
  };
  for (size_t i = 0; i + 2 < shape.mesh.face_vertex.size(); i += 3) {
    const auto& v = shape.mesh.face_vertex;
    leaves.push_back(Led({corner(v[i]), corner(v[i + 1]), corner(v[i + 2])}));
  }
  if (shape.curve) {
    const size_t count = shape.mesh.points.size();
    for (size_t i = 0; i + (shape.closed ? 0 : 1) < count; ++i) {
      leaves.push_back({corner(i), corner((i + 1) % count)});
    }
  }
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

inline std::string DigestOf(const std::vector<Leaf>& leaves) {
  Sha256 sha;
  for (const Leaf& leaf : leaves) {
    for (const Corner& c : leaf) {
      std::array<uint8_t, 56> bytes{};
      for (size_t i = 0; i < 56; ++i) {
        const uint64_t word = i < 8 ? c.id : c.bits[i / 8 - 1];
        bytes[i] = static_cast<uint8_t>(word >> (56 - 8 * (i % 8)));
      }
      sha.Update(bytes);
    }
  }
  return sha.Finish().Hex().substr(0, 16);
}

// One straight edge along x.
inline CoarseShape StraightCurve(double length = 1) {
  CoarseShape shape;
  shape.curve = true;
  shape.now = {{0, 0, 0}, {length, 0, 0}};
  shape.rest = shape.now;
  return shape;
}

// A counter-clockwise island outline of twelve points.
inline CoarseShape OutlineCurve() {
  CoarseShape shape;
  shape.curve = true;
  shape.closed = true;
  shape.now = {{1.1, .1, 0},  {.9, .7, 0},   {.3, 1.2, 0},  {-.2, .8, 0},
               {-.7, 1, 0},   {-1.2, .2, 0}, {-.8, -.3, 0}, {-.9, -.9, 0},
               {-.2, -.7, 0}, {.2, -1.1, 0}, {.8, -.8, 0},  {.7, -.2, 0}};
  shape.rest = shape.now;
  return shape;
}

// A fan of triangles over that outline.
inline CoarseShape OutlineMesh(double peak = 0) {
  CoarseShape shape = OutlineCurve();
  shape.curve = shape.closed = false;
  const auto count = static_cast<uint32_t>(shape.now.size());
  shape.now.push_back({0, 0, peak});
  shape.rest = shape.now;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    shape.triangles.push_back(next == 0 ? Triangle{0, count, i} : Triangle{i, next, count});
  }
  return shape;
}

inline FractalSettings SettingsOf(const std::string& method, double epsilon) {
  FractalSettings settings;
  settings.method = method;
  settings.fineness.epsilon = epsilon;
  return settings;
}

inline std::unique_ptr<PreparedFractal> Prepare(CoarseShape shape,
                                                const FractalSettings& settings) {
  const MethodInfo* method = FindFractalMethod(settings.method);
  FJORD_CHECK(method != nullptr, settings.method);
  auto prepared = PrepareMidpoint(*method, std::move(shape), settings);
  FJORD_CHECK(prepared.ok(), prepared.error().message);
  return std::move(prepared).value();
}

inline WeldedShape Weld(const PreparedFractal& fractal) {
  auto welded = fractal.Weld({});
  FJORD_CHECK(welded.ok(), welded.error().message);
  return std::move(welded).value();
}

}  // namespace fjord::test
