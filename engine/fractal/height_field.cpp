#include "engine/fractal/height_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random.h"

namespace fjord {
namespace {

constexpr uint32_t kBlock = 256;      // most cells along a root's side
constexpr uint32_t kLeastBlock = 16;  // H3
constexpr uint32_t kPatchCells = 64;  // along the side of what is made at a time
constexpr uint32_t kNone = 0xffffffff;

// A sample, perhaps beyond the border.
struct Index {
  uint32_t i = 0, j = 0;
  friend bool operator==(const Index&, const Index&) = default;
};

// Counter-clockwise from above.
using Node = std::array<Index, 3>;

struct IndexBox {
  uint32_t i0, j0, i1, j1;
};
IndexBox BoxOf(const Node& node) {
  return {std::min({node[0].i, node[1].i, node[2].i}), std::min({node[0].j, node[1].j, node[2].j}),
          std::max({node[0].i, node[1].i, node[2].i}), std::max({node[0].j, node[1].j, node[2].j})};
}

// What is made of one patch, each sample once. A thread keeps its own between calls.
struct Patch {
  std::vector<StreamVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<uint32_t> numbers;  // of the samples of the box, kNone: not yet there
  IndexBox box{};

  void Start(const IndexBox& samples) {
    box = samples;
    vertices.clear();
    triangles.clear();
    numbers.assign(size_t{box.i1 - box.i0 + 1} * (box.j1 - box.j0 + 1), kNone);
  }
  uint32_t& NumberOf(const Index& at) {
    return numbers[size_t{at.j - box.j0} * (box.i1 - box.i0 + 1) + (at.i - box.i0)];
  }
};

class PreparedHeights final : public PreparedFractal {
 public:
  PreparedHeights(HeightField field, const Vec3& rest_size, const Fineness& fineness, uint64_t seed)
      : field_(std::move(field)),
        rest_{field_.source, rest_size},
        fineness_(fineness),
        seed_(seed),
        last_{field_.source->columns() - 1, field_.source->rows() - 1} {
    // the largest power of two that divides both sides
    const uint32_t common = (last_.i | last_.j) & (0 - (last_.i | last_.j));
    whole_ = common < kLeastBlock;
    const uint32_t most = whole_ ? kBlock : std::min(common, kBlock);
    while (block_ < most && block_ < std::max(last_.i, last_.j)) block_ *= 2;
    across_ = (last_.i + block_ - 1) / block_;
    down_ = (last_.j + block_ - 1) / block_;
  }

  size_t RootCount() const override { return size_t{across_} * down_; }

  // It has no coarse vertices.
  Triangle Corners(uint32_t) const override { return {0, 0, 0}; }

  Ball Bound(size_t root) const override {
    const IndexBox box = Block(root);
    const HeightSource::Range range = RangeOf(box);
    const Vec3 a = field_.Place(box.i0, box.j0, range.low);
    const Vec3 b = field_.Place(std::min(box.i1, last_.i), std::min(box.j1, last_.j), range.high);
    return {(a + b) * .5, .5 * Length(b - a) * (1 + 1e-9)};
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t) const override {
    thread_local std::vector<Node> stack;
    thread_local Patch patch;
    StreamStats stats;
    const size_t bottom = stack.size();  // a sink may stream another object meanwhile
    Patch own;
    std::swap(own, patch);
    for (const Node& node : Halves(Block(root))) stack.push_back(node);
    while (stack.size() > bottom) {
      const Node node = stack.back();
      stack.pop_back();
      if (!Wanted(node, sink)) {
        ++stats.culled;
        continue;
      }
      const IndexBox box = BoxOf(node);
      if (std::max(box.i1 - box.i0, box.j1 - box.j0) > kPatchCells) {
        if (Cut(node, &stack)) continue;
      }
      Make(node, &own);
      if (own.triangles.empty()) continue;
      stats.triangles += own.triangles.size();
      sink.Take({own.vertices, own.triangles, {}, {}, 0});
    }
    std::swap(own, patch);
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override {
    WeldedShape welded;
    std::vector<uint32_t> numbers(size_t{last_.i + 1} * (last_.j + 1), kNone);
    std::vector<Node> stack;
    bool full = false;
    const auto number = [&](const Index& index) {
      const Index at = Within(index);
      uint32_t& there = numbers[SampleNumber(at)];
      if (there == kNone) {
        there = static_cast<uint32_t>(welded.mesh.points.size());
        full |= there >= limits.max_points;
        welded.mesh.points.push_back(field_.At(at.i, at.j));
        welded.identity.push_back(CoarseIdentity(seed_, SampleNumber(at)));
        welded.direction.push_back(NormalAt(at));
      }
      return there;
    };
    for (size_t root = 0; root < RootCount() && !full; ++root) {
      for (const Node& node : Halves(Block(root))) stack.push_back(node);
      while (!stack.empty() && !full) {
        const Node node = stack.back();
        stack.pop_back();
        if (Cut(node, &stack) || IsEmpty(node)) continue;
        const Triangle triangle = {number(node[0]), number(node[1]), number(node[2])};
        welded.mesh.AddFace(triangle);
      }
    }
    if (full) {
      return MakeError(ErrorCode::kLimit, "the height field has more than " +
                                              std::to_string(limits.max_points) +
                                              " points at this fineness; make it coarser");
    }
    welded.level.assign(welded.mesh.points.size(), 0);
    welded.coast.assign(welded.mesh.points.size(), 0);
    return welded;
  }

  size_t Bytes() const override { return sizeof(*this) + field_.source->Bytes(); }

 private:
  IndexBox Block(size_t root) const {
    const auto i = static_cast<uint32_t>(root % across_) * block_;
    const auto j = static_cast<uint32_t>(root / across_) * block_;
    return {i, j, i + block_, j + block_};
  }

  // The two right triangles of a square; diagonals alternate from square to square.
  static std::array<Node, 2> Halves(const IndexBox& box) {
    const Index a{box.i0, box.j0}, b{box.i1, box.j0}, c{box.i1, box.j1}, d{box.i0, box.j1};
    const uint32_t side = box.i1 - box.i0;
    if ((box.i0 / side + box.j0 / side) % 2 == 0) return {Node{a, b, c}, Node{a, c, d}};
    return {Node{a, b, d}, Node{b, c, d}};
  }

  Index Within(const Index& at) const { return {std::min(at.i, last_.i), std::min(at.j, last_.j)}; }
  uint64_t SampleNumber(const Index& at) const { return uint64_t{at.j} * (last_.i + 1) + at.i; }
  Vec3 PlaceOf(const Index& index) const {
    const Index at = Within(index);
    return field_.At(at.i, at.j);
  }
  HeightSource::Range RangeOf(const IndexBox& box) const {
    return field_.source->RangeOf(std::min(box.i0, last_.i), std::min(box.j0, last_.j),
                                  std::min(box.i1, last_.i), std::min(box.j1, last_.j));
  }

  // Corners drawn together onto the border: nothing is left of the triangle.
  bool IsEmpty(const Node& node) const {
    const Index a = Within(node[0]), b = Within(node[1]), c = Within(node[2]);
    return (a.i == b.i && b.i == c.i) || (a.j == b.j && b.j == c.j);
  }

  // H1. The same for both triangles at an edge: sums, and squares of differences, do not know an
  // order.
  bool IsLong(const Index& a, const Index& b) const {
    if ((((a.i ^ b.i) | (a.j ^ b.j)) & 1) != 0 || a == b) return false;
    if (whole_ || (fineness_.focal <= 0 && fineness_.epsilon <= 0)) return true;
    const Index first = Within(a), second = Within(b);
    const Vec3 p = rest_.At(first.i, first.j), q = rest_.At(second.i, second.j);
    const Vec3 edge = q - p;
    const double length = std::sqrt(glm::dot(edge, edge));
    if (fineness_.focal <= 0) return length > fineness_.epsilon;
    const double distance = Length((p + q) * .5 - fineness_.eye) - fineness_.eye_radius;
    const double far = distance > fineness_.near ? distance : fineness_.near;
    return length * fineness_.focal > fineness_.pixels * far;
  }

  static Index Middle(const Index& a, const Index& b) { return {(a.i + b.i) / 2, (a.j + b.j) / 2}; }

  // The children by the template of the long edges (S21); false where there are none: a leaf.
  bool Cut(const Node& node, std::vector<Node>* children) const {
    bool is_long[3];
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      is_long[k] = IsLong(node[k], node[(k + 1) % 3]);
      count += is_long[k] ? 1 : 0;
    }
    if (count == 0) return false;
    int first = 0;  // turned so that the long edges come first
    if (count == 1) {
      while (!is_long[first]) ++first;
    } else if (count == 2) {
      while (is_long[(first + 2) % 3]) ++first;
    }
    const Index c0 = node[first], c1 = node[(first + 1) % 3], c2 = node[(first + 2) % 3];
    const Index m0 = Middle(c0, c1);
    if (count == 1) {
      children->push_back({c0, m0, c2});
      children->push_back({m0, c1, c2});
      return true;
    }
    const Index m1 = Middle(c1, c2);
    children->push_back({m0, c1, m1});
    if (count == 3) {
      const Index m2 = Middle(c2, c0);
      children->push_back({c0, m0, m2});
      children->push_back({m2, m1, c2});
      children->push_back({m0, m1, m2});
      return true;
    }
    // of the rest the diagonal from the midpoint of the longer edge
    if (Span2(c0, c1) >= Span2(c1, c2)) {
      children->push_back({m0, m1, c2});
      children->push_back({c0, m0, c2});
    } else {
      children->push_back({c0, m0, m1});
      children->push_back({c0, m1, c2});
    }
    return true;
  }

  static uint64_t Span2(const Index& a, const Index& b) {
    const uint64_t i = a.i > b.i ? a.i - b.i : b.i - a.i, j = a.j > b.j ? a.j - b.j : b.j - a.j;
    return i * i + j * j;
  }

  // May any of it be seen? It stands over its triangle, between the lowest and the highest of its
  // samples; what is drawn onto the border comes from at most as far beyond.
  bool Wanted(const Node& node, StreamSink& sink) const {
    const IndexBox box = BoxOf(node);
    if (box.i0 >= last_.i || box.j0 >= last_.j) return false;
    const HeightSource::Range range = RangeOf(box);
    const double low = field_.size.z * double{range.low}, high = field_.size.z * double{range.high};
    Vec3 corner[3];
    double along = 0;
    for (int k = 0; k < 3; ++k) {
      const Index at = Within(node[k]);
      corner[k] = field_.Place(node[k].i, node[k].j, field_.source->At(at.i, at.j));
      for (const double end : {low, high}) {
        along = std::max({along, end - corner[k].z, corner[k].z - end});
      }
    }
    const Vec3 beyond = field_.Place(std::max(box.i1, last_.i), std::max(box.j1, last_.j), 0) -
                        field_.Place(last_.i, last_.j, 0);
    StreamReach reach(Length(beyond) + Length(field_.size) * 1e-12);
    reach.along = along * (1 + 1e-9);
    reach.way = {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)};
    return sink.Wants(corner[0], corner[1], corner[2], reach);
  }

  // By the samples on either side.
  Vec3 NormalAt(const Index& at) const {
    const Vec3 east = field_.At(std::min(at.i + 1, last_.i), at.j);
    const Vec3 west = field_.At(at.i > 0 ? at.i - 1 : 0, at.j);
    const Vec3 north = field_.At(at.i, std::min(at.j + 1, last_.j));
    const Vec3 south = field_.At(at.i, at.j > 0 ? at.j - 1 : 0);
    return Unit(glm::cross(east - west, north - south), Vec3(0, 0, 1));
  }

  uint32_t VertexOf(const Index& index, Patch* patch) const {
    uint32_t& number = patch->NumberOf(index);
    if (number == kNone) {
      const Index at = Within(index);
      number = static_cast<uint32_t>(patch->vertices.size());
      patch->vertices.push_back(
          {field_.At(at.i, at.j), NormalAt(at), CoarseIdentity(seed_, SampleNumber(at)).lo, 1, 0});
    }
    return number;
  }

  void Make(const Node& node, Patch* patch) const {
    patch->Start(BoxOf(node));
    std::vector<Node> stack = {node};
    while (!stack.empty()) {
      const Node next = stack.back();
      stack.pop_back();
      if (Cut(next, &stack) || IsEmpty(next)) continue;
      const Triangle triangle = {VertexOf(next[0], patch), VertexOf(next[1], patch),
                                 VertexOf(next[2], patch)};
      patch->triangles.push_back(triangle);
    }
  }

  const HeightField field_;
  const HeightField rest_;
  const Fineness fineness_;
  const uint64_t seed_;
  const Index last_;    // sample
  bool whole_ = false;  // H3: every sample is drawn
  uint32_t block_ = 1;  // cells along a root's side
  uint32_t across_ = 0, down_ = 0;
};

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PrepareHeights(const HeightField& field,
                                                        const Vec3& rest_size,
                                                        const Fineness& fineness, uint64_t seed) {
  const uint64_t samples = uint64_t{field.source->columns()} * field.source->rows();
  if (samples >= uint64_t{1} << 31) {
    return MakeError(ErrorCode::kLimit, "a height field of " + std::to_string(samples) +
                                            " samples; fewer than 2,147,483,648 can be drawn");
  }
  return std::unique_ptr<PreparedFractal>(
      std::make_unique<PreparedHeights>(field, rest_size, fineness, seed));
}

}  // namespace fjord
