#include "engine/fractal/curve.h"

#include <optional>

#include "engine/fractal/curve_additions.h"
#include "engine/fractal/curve_chain.h"
#include "engine/fractal/curve_rules.h"
#include "engine/fractal/line_walk.h"

namespace fjord {
namespace {

// Gathers leaves, gives them away a batch at a time. Neighbours in the chain share their vertex.
class SegmentBatch {
 public:
  SegmentBatch(StreamSink& sink, size_t size, size_t element)
      : sink_(sink),
        size_(size < 16 ? 16 : size),
        element_(static_cast<uint32_t>(element)),
        places_read_(sink.ReadsPlaces()) {}

  void Add(const LineSegment& leaf) {
    if (segments_.empty() || !(last_ == leaf.a.id)) {
      Push(leaf.a);
    }
    Push(leaf.b);
    last_ = leaf.b.id;
    const auto count = static_cast<uint32_t>(vertices_.size());
    segments_.push_back({count - 2, count - 1});
    if (segments_.size() >= size_) {
      Flush();
    }
  }

  void Flush() {
    if (!segments_.empty()) {
      sink_.Take({vertices_, {}, segments_, places_, element_});
    }
    vertices_.clear();
    segments_.clear();
    places_.clear();
  }

 private:
  void Push(const LineVertex& v) {
    vertices_.push_back(ToStream(v));
    if (places_read_) {
      places_.push_back(v.place);
    }
  }

  StreamSink& sink_;
  const size_t size_;
  const uint32_t element_;
  const bool places_read_;
  Identity last_;
  std::vector<StreamVertex> vertices_;
  std::vector<std::array<uint32_t, 2>> segments_;
  std::vector<Weights> places_;
};

// Halves the segments of one input edge.
template <typename Wants, typename TakeLeaf>
struct CurveVisitor {
  const LineRules& rules;
  const LineFrame& frame;
  const std::optional<CurveAdditions>& additions;
  std::optional<CurveAdditions::Line> line;  // with additions
  const Wants& wants;
  const TakeLeaf& take;

  LineRules::Size Measure(const LineSegment& s) const { return rules.Measure(s); }
  bool IsWanted(const LineSegment& s) const { return wants(s); }
  bool Take(const LineSegment& s) const { return take(s); }
  bool Divide(const LineSegment& s, const LineRules::Size& size,
              LineTree<LineSegment>* tree) const {
    LineVertex middle = rules.Halve(s, frame, size).vertex;
    if (line) {
      middle.position = additions->Place(*line, 2 * s.place + 1, s.level() + 1);
    }
    tree->push_back(rules.Second(s, middle));
    tree->push_back(rules.First(s, middle));
    return true;
  }
};

class PreparedCurve : public PreparedFractal {
 public:
  PreparedCurve(CurveChain chain, LineRules rules)
      : chain_(std::move(chain)), rules_(std::move(rules)) {
    if (rules_.settings().increments == Increments::kAdditions) {
      additions_.emplace(rules_.settings());
    }
  }

  size_t RootCount() const override { return chain_.EdgeCount(); }

  Triangle Corners(uint32_t element) const override {
    return {element, chain_.Next(element), chain_.Next(element)};
  }

  Ball Bound(size_t root) const override {
    const LineSegment edge = chain_.Edge(root);
    return {(edge.a.position + edge.b.position) * .5,
            .5 * Length(edge.b.position - edge.a.position) * (1 + 1e-12) + Reach(edge, edge)};
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t patch_hint) const override {
    StreamStats stats;
    SegmentBatch batch(sink, patch_hint, root);
    const LineSegment edge = chain_.Edge(root);
    Walk(
        root, &stats,
        [&](const LineSegment& s) {
          return sink.Wants(s.a.position, s.b.position, s.b.position, Reach(s, edge));
        },
        [&](const LineSegment& leaf) {
          batch.Add(leaf);
          return true;
        });
    batch.Flush();
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override {
    WeldedShape shape;
    shape.curve = true;
    shape.closed = chain_.closed;
    const auto add = [&](const LineVertex& v, size_t root) {
      shape.mesh.points.push_back(v.position);
      shape.identity.push_back(v.id);
      shape.level.push_back(static_cast<uint8_t>(v.level));
      shape.direction.push_back(v.direction);
      shape.coast.push_back(0);
      if (!chain_.colors.empty()) {
        shape.mesh.colors.push_back(ColorAt(root, v.place));
      }
    };
    for (size_t root = 0; root < RootCount(); ++root) {
      StreamStats stats;
      const bool complete = Walk(
          root, &stats, [](const LineSegment&) { return true; },
          [&](const LineSegment& leaf) {
            add(leaf.a, root);
            return shape.mesh.points.size() <= limits.max_points;
          });
      if (!complete) {
        return MakeError(ErrorCode::kLimit, "the curve has more than " +
                                                std::to_string(limits.max_points) +
                                                " points; choose a coarser fineness");
      }
    }
    if (!chain_.closed) {
      const size_t last = RootCount() - 1;
      add(chain_.Edge(last).b, last);
    }
    return shape;
  }

  size_t Bytes() const override {
    return sizeof(*this) + VectorBytes(chain_.vertices) + VectorBytes(chain_.frames) +
           VectorBytes(chain_.rest2);
  }

 private:
  Rgb ColorAt(size_t root, const Weights& place) const {
    return chain_.colors[root] * static_cast<float>(place.x) +
           chain_.colors[chain_.Next(root)] * static_cast<float>(place.y);
  }

  // What lies below a segment of the edge. Additions move a segment's ends as far as its inside, so
  // a point may be anywhere within the edge's reach of the edge: twice that of the segment.
  double Reach(const LineSegment& segment, const LineSegment& edge) const {
    return additions_ ? 2 * additions_->Reach(edge) : rules_.Reach(segment);
  }

  // wants(segment): is anything of it needed. take(leaf): false ends the walk; then so does Walk.
  template <typename Wants, typename Take>
  bool Walk(size_t root, StreamStats* stats, const Wants& wants, const Take& take) const {
    const LineSegment edge = chain_.Edge(root);
    CurveVisitor<Wants, Take> visitor{rules_, chain_.frames[root], additions_, {}, wants, take};
    if (additions_) {
      visitor.line = additions_->Start(edge, visitor.frame);
    }
    return WalkLine(edge, visitor, stats);
  }

  CurveChain chain_;
  LineRules rules_;
  std::optional<CurveAdditions> additions_;
};

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PrepareCurve(CoarseShape shape,
                                                      const FractalSettings& settings) {
  Result<LineRules> rules = LineRules::Make(settings);
  if (!rules.ok()) {
    return rules.error();
  }
  Result<CurveChain> chain = MakeCurveChain(shape, settings);
  if (!chain.ok()) {
    return chain.error();
  }
  return std::unique_ptr<PreparedFractal>(
      std::make_unique<PreparedCurve>(std::move(*chain), std::move(*rules)));
}

}  // namespace fjord
