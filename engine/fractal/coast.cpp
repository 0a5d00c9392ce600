#include "engine/fractal/coast.h"

#include <cmath>
#include <map>
#include <string>

#include "engine/fractal/amount.h"
#include "engine/fractal/coast_batch.h"
#include "engine/fractal/coast_pieces.h"
#include "engine/fractal/line_walk.h"

namespace fjord {
namespace {

// Each half keeps at least this share of the area of the piece that is cut; an undisplaced cut
// leaves it a half.
constexpr double kLeastShare = .0625;

// The apex of an outward cut's halves lies on the way from the unmoved midpoint to the old apex:
// kNearest of it where the cut rises by kFullRise of the segment or more, further in where it rises
// less, so that the halves have room; never nearer than kNearest to either end.
constexpr double kNearest = .0625;
constexpr double kFullRise = .2;

// Twice the area of a, b, c, counted positive where they turn left about n.
double Turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& n) {
  return glm::dot(glm::cross(b - a, c - a), n);
}

// A piece on its way down, with its border edge as a line.
struct Node {
  LineSegment edge;
  CoastVertex o;
  Vec3 normal_s;
  Vec3 normal_e;

  uint32_t level() const { return edge.level(); }
};

Node RootOf(const CoastPiece& piece) {
  return {{piece.s.line, piece.e.line, piece.rest2, 0}, piece.o, piece.s.normal, piece.e.normal};
}

// What a cut makes: the displaced point, and the halves' new apex where its inside is sealed off.
struct Cut {
  CoastVertex p;
  CoastVertex apex;
  bool sealed = false;
};

CoastVertex Start(const Node& n) { return {n.edge.a, n.normal_s, true}; }
CoastVertex End(const Node& n) { return {n.edge.b, n.normal_e, true}; }

// The share of the way from `middle` to p at which both halves keep their least area under apex o.
// Their areas are linear in the offset.
double ShareThatFits(const Vec3& s, const Vec3& e, const Vec3& o, const Vec3& middle, const Vec3& p,
                     const Vec3& plane) {
  const double least = kLeastShare * Turn(s, e, o, plane);
  double share = 1;
  for (const auto& [a, b] : {std::pair(s, o), std::pair(o, e)}) {
    const double unmoved = Turn(b, a, middle, plane);
    const double moved = Turn(b, a, p, plane);
    if (moved < least) {
      const double most = unmoved > least ? (unmoved - least) / (unmoved - moved) : 0;
      share = most < share ? most : share;
    }
  }
  return share;
}

// The share of the way from `middle` to o where an outward cut to p seals off.
double ApexShare(const Vec3& s, const Vec3& e, const Vec3& p, const Vec3& plane) {
  const double rise = Turn(s, p, e, plane) / glm::dot(e - s, e - s);
  const double share = 1 - rise / kFullRise;
  return share > 1 - kNearest ? 1 - kNearest : (share > kNearest ? share : kNearest);
}

// Which of the two cuts is made follows from the draw alone, and places are continuous in the
// places of s, e and o: so the triangles are the same in every frame and nothing jumps.
Cut MakeCut(const LineRules& rules, const Node& node, const LineFrame& frame,
            const LineRules::Size& size) {
  const LineHalf half = rules.Halve(node.edge, frame, size);
  const Vec3& s = node.edge.a.position;
  const Vec3& e = node.edge.b.position;
  const Vec3& o = node.o.line.position;
  const Vec3& p = half.vertex.position;
  Cut cut;
  cut.p = {half.vertex, Unit(node.normal_s + node.normal_e, node.normal_s), true};
  cut.sealed = half.draw >= 0;
  cut.apex = node.o;
  if (cut.sealed) {
    cut.apex = cut.p;
    cut.apex.coast = false;
    const double inward = ApexShare(s, e, p, frame.plane);
    cut.apex.line.position = half.middle + (o - half.middle) * inward;
    cut.apex.line.place = half.vertex.place + (node.o.line.place - half.vertex.place) * inward;
    cut.apex.line.id = {DrawBits(half.vertex.id.lo, 31), Mix64(half.vertex.id.hi ^ 31)};
  }
  const double share = ShareThatFits(s, e, cut.apex.line.position, half.middle, p, frame.plane);
  if (share < 1) {
    cut.p.line.position = half.middle + half.vertex.direction * (half.offset * share);
  }
  return cut;
}

// Cuts the pieces that grow from one border edge.
template <typename Wants, typename TakeTriangle>
struct CoastVisitor {
  const LineRules& rules;
  const LineFrame& frame;
  StreamStats* stats;
  const Wants& wants;
  const TakeTriangle& take;

  LineRules::Size Measure(const Node& n) const { return rules.Measure(n.edge); }
  bool IsWanted(const Node& n) const {
    return wants(n.edge.a.position, n.edge.b.position, n.o.line.position, rules.Reach(n.edge));
  }
  bool Take(const Node& n) const { return take(Start(n), End(n), n.o); }
  bool Divide(const Node& n, const LineRules::Size& size, LineTree<Node>* tree) const {
    const Cut cut = MakeCut(rules, n, frame, size);
    if (cut.sealed) {
      stats->triangles += 2;
      if (!take(Start(n), cut.apex, n.o) || !take(cut.apex, End(n), n.o)) {
        return false;
      }
    }
    tree->push_back({rules.Second(n.edge, cut.p.line), cut.apex, cut.p.normal, n.normal_e});
    tree->push_back({rules.First(n.edge, cut.p.line), cut.apex, n.normal_s, cut.p.normal});
    return true;
  }
};

class PreparedCoast : public PreparedFractal {
 public:
  PreparedCoast(CoastMesh mesh, LineRules rules)
      : mesh_(std::move(mesh)), rules_(std::move(rules)) {}

  size_t RootCount() const override { return mesh_.triangles.size(); }

  Triangle Corners(uint32_t element) const override { return mesh_.triangles[element]; }

  Ball Bound(size_t root) const override {
    const Triangle& t = mesh_.triangles[root];
    const Vec3 corner[3] = {mesh_.vertices[t[0]].line.position, mesh_.vertices[t[1]].line.position,
                            mesh_.vertices[t[2]].line.position};
    Ball ball;
    ball.center = (corner[0] + corner[1] + corner[2]) / 3.0;
    for (const Vec3& c : corner) {
      const double distance = Length(c - ball.center) * (1 + 1e-12);
      ball.radius = distance > ball.radius ? distance : ball.radius;
    }
    double reach = 0;
    for (const CoastPiece& piece : mesh_.Pieces(root)) {
      const double its = Reach(piece);
      reach = its > reach ? its : reach;
    }
    ball.radius += reach;
    return ball;
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t patch_hint) const override {
    StreamStats stats;
    TriangleBatch batch(sink, patch_hint, root);
    Walk(
        root, &stats,
        [&](const Vec3& a, const Vec3& b, const Vec3& c, double reach) {
          return sink.Wants(a, b, c, reach);
        },
        [&](const CoastVertex& a, const CoastVertex& b, const CoastVertex& c) {
          batch.Add(a, b, c);
          return true;
        });
    batch.Flush();
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override {
    WeldedShape shape;
    std::map<Identity, uint32_t> made;  // of the root at hand: all others share coarse ones only
    const auto add = [&](const CoastVertex& v, const Triangle& corners) {
      const auto [place, is_new] =
          made.emplace(v.line.id, static_cast<uint32_t>(shape.mesh.points.size()));
      if (is_new) {
        shape.mesh.points.push_back(v.line.position);
        shape.identity.push_back(v.line.id);
        shape.level.push_back(static_cast<uint8_t>(v.line.level));
        shape.direction.push_back(v.normal);
        shape.coast.push_back(v.coast ? 1 : 0);
        if (!mesh_.colors.empty()) {
          shape.mesh.colors.push_back(ColorAt(corners, v.line.place));
        }
      }
      return place->second;
    };
    for (uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
      CoastVertex v = mesh_.vertices[i];
      v.line.place = Weights(1, 0, 0);
      add(v, {i, i, i});
    }
    for (size_t root = 0; root < RootCount(); ++root) {
      made.clear();
      for (const uint32_t v : mesh_.triangles[root]) {
        made.emplace(mesh_.vertices[v].line.id, v);
      }
      StreamStats stats;
      const bool complete = Walk(
          root, &stats, [](const Vec3&, const Vec3&, const Vec3&, double) { return true; },
          [&](const CoastVertex& a, const CoastVertex& b, const CoastVertex& c) {
            const Triangle& t = mesh_.triangles[root];
            const uint32_t corners[3] = {add(a, t), add(b, t), add(c, t)};
            shape.mesh.AddFace(corners);
            return shape.mesh.points.size() <= limits.max_points;
          });
      if (!complete) {
        return MakeError(ErrorCode::kLimit, "the coast has more than " +
                                                std::to_string(limits.max_points) +
                                                " points; choose a coarser fineness");
      }
    }
    return shape;
  }

  size_t Bytes() const override {
    return sizeof(*this) + VectorBytes(mesh_.vertices) + VectorBytes(mesh_.triangles) +
           VectorBytes(mesh_.border_rest2);
  }

 private:
  Rgb ColorAt(const Triangle& corners, const Weights& place) const {
    return mesh_.colors[corners[0]] * static_cast<float>(place.x) +
           mesh_.colors[corners[1]] * static_cast<float>(place.y) +
           mesh_.colors[corners[2]] * static_cast<float>(place.z);
  }

  double Reach(const CoastPiece& piece) const {
    return piece.coast ? rules_.Reach({piece.s.line, piece.e.line, piece.rest2, 0}) : 0;
  }

  // wants(triangle, reach): is anything of it needed. take(a, b, c): false ends the walk; then so
  // does Walk.
  template <typename Wants, typename Take>
  bool Walk(size_t root, StreamStats* stats, const Wants& wants, const Take& take) const {
    for (const CoastPiece& piece : mesh_.Pieces(root)) {
      if (piece.coast) {
        CoastVisitor<Wants, Take> visitor{rules_, piece.frame, stats, wants, take};
        if (!WalkLine(RootOf(piece), visitor, stats)) {
          return false;
        }
        continue;
      }
      if (!wants(piece.s.line.position, piece.e.line.position, piece.o.line.position, 0)) {
        ++stats->culled;
        continue;
      }
      ++stats->triangles;
      if (!take(piece.s, piece.e, piece.o)) {
        return false;
      }
    }
    return true;
  }

  CoastMesh mesh_;
  LineRules rules_;
};

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PrepareCoast(CoarseShape shape,
                                                      const FractalSettings& settings) {
  FractalSettings resolved = settings;
  if (resolved.law == Law::kSimilar) {
    resolved.H = HeldBackH(resolved.H);
  }
  Result<LineRules> rules = LineRules::Make(resolved);
  if (!rules.ok()) {
    return rules.error();
  }
  Result<CoastMesh> mesh = MakeCoastMesh(shape, resolved);
  if (!mesh.ok()) {
    return mesh.error();
  }
  return std::unique_ptr<PreparedFractal>(
      std::make_unique<PreparedCoast>(std::move(*mesh), std::move(*rules)));
}

}  // namespace fjord
