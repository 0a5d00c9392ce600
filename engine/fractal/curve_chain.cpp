#include "engine/fractal/curve_chain.h"

#include <cmath>

namespace fjord {
namespace {

bool IsFinite(const Vec3& v) {
  const double sum = (v.x - v.x) + (v.y - v.y) + (v.z - v.z);  // NaN for infinities too
  return sum == 0;
}

// Turned to the upper half of space: z, then y, then x decide.
Vec3 Upward(const Vec3& n) {
  const bool down = n.z != 0 ? n.z < 0 : (n.y != 0 ? n.y < 0 : n.x < 0);
  return down ? n * -1.0 : n;
}

// Square to a line: in the plane x, z where it can be, so that upright lines sway sideways.
Vec3 PlaneOfLine(const Vec3& along) {
  const Vec3 unit = Unit(along, Vec3(1, 0, 0));
  const Vec3 y(0, 1, 0);
  const Vec3 rest = y - unit * glm::dot(y, unit);
  return glm::dot(rest, rest) > 1e-6 ? Upward(Unit(rest)) : Vec3(0, 0, 1);
}

// Each edge's frame; an edge without length takes no side.
void MakeFrames(const CoarseShape& shape, CurveChain* chain) {
  const std::vector<Vec3>& p = shape.now;
  const Vec3 plane = CurvePlane(p);
  const size_t edges = chain->closed ? p.size() : p.size() - 1;
  for (size_t i = 0; i < edges; ++i) {
    const size_t next = i + 1 < p.size() ? i + 1 : 0;
    chain->frames.push_back({plane, RightNormal(p[next] - p[i], plane)});
    const Vec3 rest = shape.rest[next] - shape.rest[i];
    chain->rest2.push_back(glm::dot(rest, rest));
  }
}

}  // namespace

Vec3 CurvePlane(const std::vector<Vec3>& points) {
  bool flat = true;
  double size2 = 0;
  Vec3 longest(0);
  Vec3 newell(0);
  Vec3 aligned(0);  // turns left and right add up, for curves whose signed area cancels
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 a = points[i] - points[0];
    const Vec3 b = points[i + 1 < points.size() ? i + 1 : 0] - points[0];
    flat = flat && points[i].z == points[0].z;
    const Vec3 cross = glm::cross(a, b);
    newell += cross;
    aligned += glm::dot(cross, aligned) < 0 ? cross * -1.0 : cross;
    if (glm::dot(a, a) > size2) {
      size2 = glm::dot(a, a);
      longest = a;
    }
  }
  if (flat) {
    return {0, 0, 1};
  }
  const double least = 1e-9 * size2;
  if (Length(newell) > least) {
    return Upward(Unit(newell));
  }
  return Length(aligned) > least ? Upward(Unit(aligned)) : PlaneOfLine(longest);
}

Result<CurveChain> MakeCurveChain(const CoarseShape& shape, const FractalSettings& settings) {
  const size_t count = shape.now.size();
  if (!shape.curve || count < 2) {
    return Invalid("curve takes a polyline of two points or more");
  }
  if (shape.rest.size() != count || (!shape.colors.empty() && shape.colors.size() != count)) {
    return Invalid("the curve's points, rest points and colours differ in number");
  }
  CurveChain chain;
  chain.closed = shape.closed;
  chain.colors = shape.colors;
  for (size_t i = 0; i < count; ++i) {
    if (!IsFinite(shape.now[i]) || !IsFinite(shape.rest[i])) {
      return Invalid("point " + std::to_string(i + 1) + " of the curve is not finite");
    }
  }
  MakeFrames(shape, &chain);
  const size_t edges = chain.EdgeCount();
  for (size_t i = 0; i < count; ++i) {
    const size_t before = i > 0 ? i - 1 : edges - 1;
    const bool has_before = i > 0 || chain.closed;
    const bool has_after = i < edges;
    LineVertex v;
    v.position = shape.now[i];
    v.id = CoarseIdentity(settings.seed, i);
    Vec3 normal(0);
    double stretch = 0;
    uint32_t stretched = 0;
    for (const auto& [has, edge] : {std::pair(has_before, before), std::pair(has_after, i)}) {
      if (!has) {
        continue;
      }
      normal += chain.frames[edge].normal;
      if (chain.rest2[edge] > 0) {
        const Vec3 now = shape.now[edge + 1 < count ? edge + 1 : 0] - shape.now[edge];
        stretch += std::sqrt(glm::dot(now, now) / chain.rest2[edge]);
        ++stretched;
      }
    }
    v.direction = Softened(normal * .5);
    v.stretch = StretchOf(stretch, stretched);
    const Vec3 eye = shape.rest[i] - settings.fineness.eye;
    v.eye_distance2 = glm::dot(eye, eye);
    chain.vertices.push_back(v);
  }
  return chain;
}

}  // namespace fjord
