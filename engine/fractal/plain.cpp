#include "engine/fractal/plain.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/normals.h"

namespace fjord {
namespace {

constexpr size_t kRun = 64;  // elements of a root

class PreparedPlain final : public PreparedFractal {
 public:
  PreparedPlain(CoarseShape shape, uint64_t seed) : shape_(std::move(shape)), seed_(seed) {
    const std::vector<Vec3> normals = shape_.curve
                                          ? std::vector<Vec3>(shape_.now.size(), Vec3(0, 0, 1))
                                          : VertexNormals(shape_.now, shape_.triangles);
    for (size_t v = 0; v < shape_.now.size(); ++v) {
      vertices_.push_back({shape_.now[v], normals[v], CoarseIdentity(seed_, v).lo, 1, 0});
    }
  }

  size_t RootCount() const override { return (ElementCount() + kRun - 1) / kRun; }

  Triangle Corners(uint32_t element) const override {
    return {Vertex(element, 0), Vertex(element, 1), Vertex(element, shape_.curve ? 1 : 2)};
  }

  Ball Bound(size_t root) const override {
    Vec3 low = Corner(root * kRun, 0), high = low;
    ForEachCorner(root, [&](const Vec3& p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    });
    Ball ball{low * .5 + high * .5, 0};
    ForEachCorner(
        root, [&](const Vec3& p) { ball.radius = std::max(ball.radius, Length(p - ball.center)); });
    ball.radius *= 1 + 1e-12;
    return ball;
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t) const override {
    StreamStats stats;
    std::vector<StreamVertex> vertices;
    std::vector<Weights> places;
    const bool places_read = sink.ReadsPlaces();
    std::vector<Triangle> triangles;
    std::vector<std::array<uint32_t, 2>> segments;
    const auto add = [&](size_t element, int corner) {
      const uint32_t v = Vertex(element, corner);
      vertices.push_back(vertices_[v]);
      if (places_read) places.push_back(Weights(corner == 0, corner == 1, corner == 2));
      return static_cast<uint32_t>(vertices.size() - 1);
    };
    // Places are those of one element: then each element is a batch of its own.
    const auto give = [&](size_t element) {
      if (vertices.empty()) return;
      sink.Take({vertices, triangles, segments, places, static_cast<uint32_t>(element)});
      stats.triangles += triangles.size();
      vertices.clear();
      triangles.clear();
      segments.clear();
      places.clear();
    };
    const size_t end = std::min(ElementCount(), (root + 1) * kRun);
    for (size_t i = root * kRun; i < end; ++i) {
      const int last = shape_.curve ? 1 : 2;
      if (!sink.Wants(Corner(i, 0), Corner(i, 1), Corner(i, last), 0)) {
        ++stats.culled;
      } else if (shape_.curve) {
        const uint32_t a = add(i, 0);
        segments.push_back({a, add(i, 1)});
      } else {
        const uint32_t a = add(i, 0);
        const uint32_t b = add(i, 1);
        triangles.push_back({a, b, add(i, 2)});
      }
      if (places_read) give(i);
    }
    give(root * kRun);
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override {
    if (shape_.now.size() > limits.max_points) {
      return MakeError(ErrorCode::kLimit,
                       "the shape has more than " + std::to_string(limits.max_points) + " points");
    }
    WeldedShape welded;
    welded.curve = shape_.curve;
    welded.closed = shape_.closed;
    welded.mesh.points = shape_.now;
    welded.mesh.colors = shape_.colors;
    for (const Triangle& triangle : shape_.triangles) welded.mesh.AddFace(triangle);
    for (size_t v = 0; v < vertices_.size(); ++v) {
      welded.identity.push_back(CoarseIdentity(seed_, v));
      welded.direction.push_back(vertices_[v].direction);
    }
    welded.level.assign(vertices_.size(), 0);
    welded.coast.assign(vertices_.size(), 0);
    return welded;
  }

  size_t Bytes() const override { return sizeof(*this) + shape_.Bytes() + VectorBytes(vertices_); }

 private:
  size_t ElementCount() const {
    if (!shape_.curve) return shape_.triangles.size();
    const size_t n = shape_.now.size();
    return n < 2 ? 0 : n - (shape_.closed ? 0 : 1);
  }
  uint32_t Vertex(size_t element, int corner) const {
    if (!shape_.curve) return shape_.triangles[element][static_cast<size_t>(corner)];
    return static_cast<uint32_t>((element + static_cast<size_t>(corner)) % shape_.now.size());
  }
  const Vec3& Corner(size_t element, int corner) const {
    return shape_.now[Vertex(element, corner)];
  }
  template <typename Body>
  void ForEachCorner(size_t root, const Body& body) const {
    const size_t end = std::min(ElementCount(), (root + 1) * kRun);
    for (size_t i = root * kRun; i < end; ++i) {
      for (int k = 0; k < (shape_.curve ? 2 : 3); ++k) body(Corner(i, k));
    }
  }

  CoarseShape shape_;
  uint64_t seed_;
  std::vector<StreamVertex> vertices_;
};

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PreparePlain(CoarseShape shape, uint64_t seed) {
  if (!shape.colors.empty() && shape.colors.size() != shape.now.size()) {
    return Invalid("the shape has " + std::to_string(shape.colors.size()) + " colours for " +
                   std::to_string(shape.now.size()) + " points");
  }
  for (const Triangle& triangle : shape.triangles) {
    for (const uint32_t corner : triangle) {
      if (corner >= shape.now.size()) {
        return Invalid("a face names point " + std::to_string(corner + uint64_t{1}) + " of " +
                       std::to_string(shape.now.size()));
      }
    }
  }
  return std::unique_ptr<PreparedFractal>(std::make_unique<PreparedPlain>(std::move(shape), seed));
}

}  // namespace fjord
