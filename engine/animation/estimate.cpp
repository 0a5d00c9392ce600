#include "engine/animation/estimate.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/animation/coarse.h"
#include "engine/animation/frame_geometry.h"
#include "engine/animation/view_cone.h"
#include "engine/base/exact_math.h"
#include "engine/base/fpenv.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/registry.h"

namespace fjord {
namespace {

constexpr size_t kMostCells = 100'000;  // looked at of one object
constexpr double kEven = 1.3;           // counts at a cell's ends that need no smaller cells
constexpr double kUneven = 2.1;         // as seen: more than by the edges' levels alone
constexpr double kSmall = 64;           // leaves, not worth looking closer
constexpr double kSmallAtBorder = 1e5;  // the same where the picture ends

double Magnitude(double x) { return x < 0 ? -x : x; }

// How many levels an edge is split, and how far its midpoints move. Lengths are what the split rule
// reads: of the rest pose, or the frame's own, which shrink less.
class EdgeLaw {
 public:
  EdgeLaw(const FractalSettings& settings, double coarser)
      : settings_(settings), current_(settings.split == Split::kLength), coarser_(coarser) {
    amount_ = settings.sigma * settings.amplitude * AffineConstant(settings.H);
    // 2^(-1/D): what is left of a length where two halves make a curve of dimension D
    similar_ = exact::Exp2(-1 / (2 - settings.H));
  }

  bool current() const { return current_; }

  // The length that is not split any further, at this distance from the eye.
  double ShortAt(double distance) const {
    const Fineness& fine = settings_.fineness;
    if (fine.focal <= 0) return fine.epsilon * coarser_;
    return fine.pixels * coarser_ * std::max(fine.near, distance - fine.eye_radius) / fine.focal;
  }

  uint32_t Levels(double length, double shortest) const {
    uint32_t level = 0;
    for (double rest = length; length > shortest && level < settings_.max_level; ++level) {
      const double offset =
          current_ && settings_.law == Law::kAffine ? amount_ * exact::Pow(rest, settings_.H) : 0;
      rest *= .5;
      length = !current_                       ? length * .5
               : settings_.law == Law::kAffine ? std::sqrt(length * length * .25 + offset * offset)
                                               : length * similar_;
    }
    return level;
  }

  // How far anything made of an edge of this length can be from it, about.
  double Reach(double length) const {
    double reach = settings_.law == Law::kAffine ? 0 : .75 * length;
    if (settings_.coast) reach += .75 * length;
    double shrink = exact::Exp2(-settings_.H), part = amount_ * exact::Pow(length, settings_.H);
    for (int i = 0; settings_.law == Law::kAffine && i < 60; ++i, part *= shrink) reach += 3 * part;
    return reach;
  }

 private:
  const FractalSettings& settings_;
  const bool current_;
  const double coarser_;
  double amount_ = 0;
  double similar_ = 0;
};

double TwoTo(uint32_t levels) { return exact::Exp2(levels); }

// Leaves of a triangle whose edges are split so many levels. While all three are long it becomes
// four of its shape, then with two long ones three, with one two. Medians may be long once more,
// and the frame's own lengths are not all alike.
double LeavesOf(std::array<uint32_t, 3> levels) {
  std::sort(levels.begin(), levels.end());
  double leaves = TwoTo(2 * levels[0]) * TwoTo(levels[2] - levels[1]);
  for (uint32_t level = levels[0]; level < levels[1]; ++level) leaves *= 3;
  return levels[0] == levels[2] ? leaves : leaves * kUneven;
}

// A piece of a coarse triangle (or of a segment, with c = b), of which leaves are counted at once.
struct Cell {
  std::array<Vec3, 3> rest, now;
  double share = 1;  // of the coarse element
};

struct Ball {
  Vec3 center;
  double radius;
};

Ball Around(const std::array<Vec3, 3>& corners) {
  const Vec3 center = (corners[0] + corners[1] + corners[2]) * (1. / 3);
  double radius = 0;
  for (const Vec3& corner : corners) radius = std::max(radius, Length(corner - center));
  return {center, radius};
}

class Estimator {
 public:
  Estimator(const v1::FrameScene& frame, const v1::FrameObject& object,
            const FractalSettings& settings, double coarser)
      : view_(frame),
        law_(settings, coarser),
        fine_(settings.fineness),
        even_(settings.increments == Increments::kEven) {
    for (size_t i = 0; i < 3; ++i) rows_[i] = {Vec3(i == 0, i == 1, i == 2), 0};
    for (int i = 0; i < 3 && object.transform_size() == 12; ++i) {
      const auto& t = object.transform();
      rows_[static_cast<size_t>(i)] = {Vec3(t[4 * i], t[4 * i + 1], t[4 * i + 2]), t[4 * i + 3]};
      stretch_ = std::max(i == 0 ? 0 : stretch_, Length(Vec3(t[i], t[4 + i], t[8 + i])));
    }
  }

  const ObjectEstimate& estimate() const { return estimate_; }

  // `split`: which edges are split, from corner k to the next. `flat`: leaves follow the edges'
  // length and not the area.
  void Add(const Cell& whole, const std::array<bool, 3>& split, bool flat, int halved = 0) {
    if (even_ && !flat && AddHalves(whole, split, halved)) return;
    const bool fan = flat && !(whole.now[1] == whole.now[2]);  // triangles along a border
    std::array<double, 3> length{};
    double longest = 0;
    for (size_t k = 0; k < 3; ++k) {
      const auto& corners = law_.current() ? whole.now : whole.rest;
      length[k] = split[k] ? Length(corners[(k + 1) % 3] - corners[k]) : 0;
      longest = std::max(longest, Length(whole.now[(k + 1) % 3] - whole.now[k]));
    }
    const double reach = stretch_ * law_.Reach(longest);
    const auto leaves_at = [&](double distance) {
      const double shortest = law_.ShortAt(distance);
      std::array<uint32_t, 3> levels{};
      double along = 0;
      for (size_t k = 0; k < 3; ++k) {
        levels[k] = law_.Levels(length[k], shortest);
        if (split[k]) along += TwoTo(levels[k]) * (fan ? kUneven : 1);
      }
      const double leaves = along > 0 && flat ? along : LeavesOf(levels);
      return leaves * (law_.current() ? kUneven : 1);
    };
    std::vector<Cell> open = {whole};
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      ++cells_;
      const Ball rest = Around(law_.current() ? cell.now : cell.rest);
      const double distance = Length(rest.center - fine_.eye);
      const double most = leaves_at(std::max(distance - rest.radius, 0.0));
      const double count = cell.share * most;
      const bool even = fine_.focal <= 0 || most <= kEven * leaves_at(distance + rest.radius);
      const Ball now = Around(cell.now);
      const double depth = view_.Depth(ToWorld(now.center));
      const double radius = now.radius * stretch_ + reach;
      const bool at_border = Magnitude(depth) < radius && now.radius * stretch_ > .1 * reach;
      const bool looks_closer = (!even && count > kSmall) || (at_border && count > kSmallAtBorder);
      if (looks_closer && cells_ + open.size() < kMostCells) {
        Halve(cell, &open);
        continue;
      }
      estimate_.leaves += count;
      if (depth > -radius) estimate_.in_view += count;
    }
  }

 private:
  Vec3 ToWorld(const Vec3& p) const {
    return {glm::dot(rows_[0].first, p) + rows_[0].second,
            glm::dot(rows_[1].first, p) + rows_[1].second,
            glm::dot(rows_[2].first, p) + rows_[2].second};
  }

  // Triangles that are cut along their median (shares.h) keep its length, where it is short, and
  // not their shape. One without an area could be halved for ever.
  bool AddHalves(const Cell& whole, const std::array<bool, 3>& split, int halved) {
    constexpr double kShort = .25;
    constexpr int kDeepest = 8;
    if (halved == kDeepest || cells_ >= kMostCells) return false;
    const auto& corners = law_.current() ? whole.now : whole.rest;
    size_t k = 0;  // the longest side's first corner
    const auto side = [&](size_t i) { return Length(corners[(i + 1) % 3] - corners[i]); };
    for (size_t i = 1; i < 3; ++i) {
      if (side(i) > side(k)) k = i;
    }
    const size_t next = (k + 1) % 3, across = (k + 2) % 3;
    const Vec3 middle = (corners[k] + corners[next]) * .5;
    if (!(Length(corners[across] - middle) < kShort * side(k))) return false;
    for (const size_t end : {next, k}) {
      Cell half = whole;
      half.rest[end] = (whole.rest[k] + whole.rest[next]) * .5;
      half.now[end] = (whole.now[k] + whole.now[next]) * .5;
      std::array<bool, 3> halves = split;
      halves[end == next ? next : across] = true;  // the median
      Add(half, halves, false, halved + 1);
    }
    return true;
  }

  static void Halve(const Cell& cell, std::vector<Cell>* halves) {
    size_t longest = 0;
    double most = -1;
    for (size_t k = 0; k < 3; ++k) {
      const double length = Length(cell.now[(k + 1) % 3] - cell.now[k]) +
                            Length(cell.rest[(k + 1) % 3] - cell.rest[k]);
      if (length > most) {
        most = length;
        longest = k;
      }
    }
    const size_t next = (longest + 1) % 3;
    const bool segment = cell.rest[1] == cell.rest[2] && cell.now[1] == cell.now[2];
    for (const size_t end : {longest, next}) {
      Cell& half = halves->emplace_back(cell);
      half.share *= .5;
      half.rest[end] = (cell.rest[longest] + cell.rest[next]) * .5;
      half.now[end] = (cell.now[longest] + cell.now[next]) * .5;
      if (!segment) continue;  // keeps c = b
      half.rest[2] = half.rest[1];
      half.now[2] = half.now[1];
    }
  }

  const ViewCone view_;
  const EdgeLaw law_;
  const Fineness& fine_;
  const bool even_;
  std::array<std::pair<Vec3, double>, 3> rows_;
  double stretch_ = 1;
  size_t cells_ = 0;
  ObjectEstimate estimate_;
};

using Edge = std::pair<uint32_t, uint32_t>;

Edge EdgeOf(uint32_t a, uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Edges of one triangle alone, ascending.
std::vector<Edge> BorderEdges(const CoarseShape& shape) {
  std::vector<Edge> all, border;
  for (const Triangle& t : shape.triangles) {
    for (size_t k = 0; k < 3; ++k) all.push_back(EdgeOf(t[k], t[(k + 1) % 3]));
  }
  std::sort(all.begin(), all.end());
  for (size_t i = 0; i < all.size(); ++i) {
    const bool twin =
        (i > 0 && all[i - 1] == all[i]) || (i + 1 < all.size() && all[i + 1] == all[i]);
    if (!twin) border.push_back(all[i]);
  }
  return border;
}

}  // namespace

Result<ObjectEstimate> EstimateObject(const v1::FrameScene& frame, const AssetResolver* assets,
                                      int index, double coarser) {
  SetFloatEnvironment();
  const v1::FrameObject& object = frame.object(index);
  const Result<CoarseShape> shape = CoarseShapeOf(object, assets);
  if (!shape) return shape.error();
  FractalSettings settings;
  settings.max_level = 0;
  bool borders_only = false;
  if (object.has_fractal()) {
    const Result<MethodSettings> known = MethodSettingsOf(object.fractal());
    if (!known) return known.error();
    const MethodInfo& method = *FindFractalMethod(known->method);
    if (method.midpoint != nullptr) {
      settings = method.midpoint(*known, known->own);
    } else {
      static_cast<FractalCommon&>(settings) = *known;
    }
    borders_only = method.borders_only;
  }
  Estimator estimator(frame, object, settings, coarser);
  const size_t points = shape->now.size();
  for (size_t i = 0; shape->curve && i + (shape->closed ? 0 : 1) < points; ++i) {
    const size_t next = (i + 1) % points;
    estimator.Add({{shape->rest[i], shape->rest[next], shape->rest[next]},
                   {shape->now[i], shape->now[next], shape->now[next]}},
                  {true, false, false}, true);
  }
  std::vector<Edge> border;
  if (borders_only) border = BorderEdges(*shape);
  for (const Triangle& t : shape->triangles) {
    std::array<bool, 3> split = {true, true, true};
    for (size_t k = 0; borders_only && k < 3; ++k) {
      split[k] = std::binary_search(border.begin(), border.end(), EdgeOf(t[k], t[(k + 1) % 3]));
    }
    estimator.Add({{shape->rest[t[0]], shape->rest[t[1]], shape->rest[t[2]]},
                   {shape->now[t[0]], shape->now[t[1]], shape->now[t[2]]}},
                  split, borders_only);
  }
  ObjectEstimate estimate = estimator.estimate();
  if (shape->heights) {  // never more than there are samples
    const HeightSource& source = *shape->heights->source;
    estimate.leaves = estimate.in_view = 2. * (source.columns() - 1.) * (source.rows() - 1.);
  }
  const Result<PlacementList> placements = PlacementsOf(object, assets);
  if (!placements) return placements.error();
  const double times = placements->empty() ? 1 : static_cast<double>(placements->size());
  estimate.leaves *= times;
  estimate.in_view *= times;
  return estimate;
}

Result<FrameEstimate> EstimateFrame(const v1::FrameScene& frame, const AssetResolver* assets) {
  FrameEstimate estimate;
  for (int i = 0; i < frame.object_size(); ++i) {
    Result<ObjectEstimate> object = EstimateObject(frame, assets, i);
    if (!object) return object.error();
    estimate.all.leaves += object->leaves;
    estimate.all.in_view += object->in_view;
    estimate.objects.push_back(*object);
  }
  return estimate;
}

}  // namespace fjord
