#include "engine/render/wireframe_edges.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "engine/render/build.h"
#include "engine/render/clip.h"
#include "engine/render/cull.h"
#include "engine/render/edge_set.h"
#include "engine/render/places.h"
#include "engine/render/view.h"

namespace fjord {
namespace {

constexpr double kCoarsest = 1e12;
constexpr size_t kHeld = 4;  // times what may stay, before the shorter ones fall out

bool IsBefore(const ScreenEdge& a, const ScreenEdge& b) {
  return std::tie(a.place, a.from, a.to) < std::tie(b.place, b.from, b.to);
}

double SquaredLength(const ScreenEdge& edge) {
  const double x = edge.x1 - edge.x0, y = edge.y1 - edge.y0;
  return x * x + y * y;
}

// Liang-Barsky against -1 .. size + 1.
bool CutToPicture(const BuiltFrame& frame, ScreenEdge* s) {
  const auto inside = [&](double x, double y) {
    return x >= -1 && x <= frame.width + 1. && y >= -1 && y <= frame.height + 1.;
  };
  if (inside(s->x0, s->y0) && inside(s->x1, s->y1)) return true;
  const double dx = s->x1 - s->x0, dy = s->y1 - s->y0;
  double from = 0, to = 1;
  const auto side = [&](double p, double q) {  // p t <= q
    if (p == 0) return q >= 0;
    const double t = q / p;
    if (p < 0) {
      from = std::max(from, t);
    } else {
      to = std::min(to, t);
    }
    return from <= to;
  };
  if (!side(-dx, s->x0 + 1) || !side(dx, frame.width + 1 - s->x0) || !side(-dy, s->y0 + 1) ||
      !side(dy, frame.height + 1 - s->y0)) {
    return false;
  }
  const double x0 = s->x0, y0 = s->y0;
  s->x0 = x0 + dx * from;
  s->y0 = y0 + dy * from;
  s->x1 = x0 + dx * to;
  s->y1 = y0 + dy * to;
  return true;
}

// One end of an edge on its way to the picture.
struct End {
  uint64_t id = 0;
  ClipPoint clip;
  double x = 0, y = 0;    // pixels
  bool is_plain = false;  // before the eye and not far away: x and y are its place
};

class EdgeCollector {
 public:
  // longest_only: more than `most` are no reason to stop.
  EdgeCollector(const BuiltFrame& frame, size_t most, bool longest_only)
      : frame_(frame), most_(most), longest_only_(longest_only) {}

  void StartPlace(uint32_t place, const Projection& to) {
    place_ = place;
    to_ = to;
  }

  // All edges of a batch.
  void Add(const StreamBatch& batch) {
    ends_.clear();
    for (const StreamVertex& vertex : batch.vertices) ends_.push_back(MakeEnd(vertex));
    for (const Triangle& t : batch.triangles) {
      for (size_t k = 0; k < 3; ++k) Add(ends_[t[k]], ends_[t[(k + 1) % 3]]);
    }
    for (const auto& segment : batch.segments) Add(ends_[segment[0]], ends_[segment[1]]);
  }

  // Are there too many already?
  bool Full() const { return !longest_only_ && edges_.size() > most_; }

  // In order.
  std::vector<ScreenEdge> Take() {
    if (longest_only_) KeepLongest();
    std::sort(edges_.begin(), edges_.end(), IsBefore);
    return std::move(edges_);
  }
  bool left_any() const { return left_any_; }

 private:
  End MakeEnd(const StreamVertex& vertex) const {
    constexpr double kFar = .5 * kFixedGuard;
    End end{vertex.id, ToClip(to_, vertex.position)};
    if (!(end.clip.z > to_.near)) return end;
    const double scale = to_.orthographic ? 1 : 1 / end.clip.z;
    const double x = end.clip.x * scale, y = end.clip.y * scale;
    end.is_plain = x > -kFar && x < kFar && y > -kFar && y < kFar;
    end.x = x / kFixedOne;
    end.y = y / kFixedOne;
    return end;
  }

  void Add(const End& one, const End& other) {
    if (Full()) return;
    const End &a = one.id < other.id ? one : other, &b = one.id < other.id ? other : one;
    ScreenEdge edge{a.x, a.y, b.x, b.y, place_, a.id, b.id};
    if (!(a.is_plain && b.is_plain) && !Clip(a, b, &edge)) return;
    if (!CutToPicture(frame_, &edge) || !met_.Insert(place_, a.id, b.id)) return;
    edges_.push_back(edge);
    if (longest_only_ && edges_.size() > kHeld * most_) KeepLongest();
  }

  bool Clip(const End& a, const End& b, ScreenEdge* edge) const {
    ClipPolygon line;
    line.size = 2;
    line.corner[0].clip = a.clip;
    line.corner[1].clip = b.clip;
    ClipToView(to_, &line);
    if (line.size != 2) return false;
    double x[2], y[2];
    for (int i = 0; i < 2; ++i) {
      const ClipPoint& p = line.corner[i].clip;
      const double scale = (to_.orthographic ? 1 : 1 / p.z) / kFixedOne;
      x[i] = p.x * scale;
      y[i] = p.y * scale;
    }
    edge->x0 = x[0];
    edge->y0 = y[0];
    edge->x1 = x[1];
    edge->y1 = y[1];
    return true;
  }

  // Shorter ones that come again are let in again, and fall out again.
  void KeepLongest() {
    if (edges_.size() <= most_) return;
    left_any_ = true;
    const auto end = edges_.begin() + static_cast<std::ptrdiff_t>(most_);
    std::nth_element(edges_.begin(), end, edges_.end(),
                     [](const ScreenEdge& a, const ScreenEdge& b) {
                       const double of_a = SquaredLength(a), of_b = SquaredLength(b);
                       return of_a != of_b ? of_a > of_b : IsBefore(a, b);
                     });
    edges_.erase(end, edges_.end());
    met_.Clear();
    for (const ScreenEdge& edge : edges_) met_.Insert(edge.place, edge.from, edge.to);
  }

  const BuiltFrame& frame_;
  const size_t most_;
  const bool longest_only_;
  uint32_t place_ = 0;
  Projection to_;
  std::vector<End> ends_;  // of a batch
  std::vector<ScreenEdge> edges_;
  EdgeSet met_;
  bool left_any_ = false;
};

// Takes what may touch the picture of what a fractal streams.
class EdgeSink final : public StreamSink {
 public:
  EdgeSink(const TileFrustum& frustum, EdgeCollector* edges) : frustum_(frustum), edges_(edges) {}

  bool Wants(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) override {
    return !edges_->Full() && frustum_.MayTouch(a, b, c, reach);
  }
  void Take(const StreamBatch& batch) override { edges_->Add(batch); }

 private:
  const TileFrustum& frustum_;
  EdgeCollector* edges_;
};

// All edges at one fineness; fewer where the collector is full.
Result<uint64_t> Collect(const BuiltFrame& frame, double coarser, EdgeCollector* edges) {
  const View view = MakeView(frame.camera, frame.width, frame.height);
  const TileRect whole{0, 0, static_cast<int32_t>(frame.width), static_cast<int32_t>(frame.height)};
  uint64_t made = 0;
  uint32_t number = 0;
  const BuiltObject* prepared_of = nullptr;
  std::shared_ptr<const PreparedFractal> prepared;
  for (const ObjectPlace& place : PlacesSeen(frame, view)) {
    if (edges->Full()) break;
    const BuiltObject& object = frame.objects[place.object];
    if (&object != prepared_of) {
      prepared_of = &object;
      prepared = object.prepared;
      if (coarser != 1) {
        auto made_coarser = PrepareObject(object, coarser);
        if (!made_coarser) return made_coarser.error();
        prepared = std::move(*made_coarser);
      }
    }
    const CullObject cull{prepared.get(), MakeProjection(view, place.transform)};
    edges->StartPlace(number++, cull.to);
    const TileFrustum frustum(cull, whole);
    EdgeSink sink(frustum, edges);
    for (size_t root = 0; root < prepared->RootCount() && !edges->Full(); ++root) {
      const Ball ball = prepared->Bound(root);
      if (!frustum.MayTouch(ball.center, ball.center, ball.center, ball.radius)) continue;
      made += prepared->Stream(root, sink, 256).triangles;
    }
  }
  return made;
}

}  // namespace

Result<FrameEdges> EdgesInView(const BuiltFrame& frame, size_t most) {
  FrameEdges found;
  // The coarse shapes alone are too many: no fineness will do.
  EdgeCollector coarse(frame, most, true);
  const Result<uint64_t> made = Collect(frame, kCoarsest, &coarse);
  if (!made) return made.error();
  found.made = *made;
  found.edges = coarse.Take();
  found.coarser = kCoarsest;
  found.longest_only = coarse.left_any();
  if (found.longest_only) return found;
  for (double coarser = 1; coarser < kCoarsest; coarser *= 2) {
    EdgeCollector edges(frame, most, false);
    const Result<uint64_t> more = Collect(frame, coarser, &edges);
    if (!more) return more.error();
    found.made += *more;
    if (edges.Full()) continue;
    found.edges = edges.Take();
    found.coarser = coarser;
    return found;
  }
  return found;
}

}  // namespace fjord
