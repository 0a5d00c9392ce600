// Split ADAPTIVE is continuous in the camera for lines, too: curves, coasts, and the coast of a
// surface. However little the camera moves, no vertex jumps, and one that comes or goes lies on the
// line it leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/geometry/border.h"
#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

constexpr double kFocal = 600;
constexpr double kSmallestMove = 1e-12;

struct LinePoint {
  Identity id;
  Vec3 place{0};
};
using Line = std::vector<LinePoint>;  // closed

// The curve itself, or the border of the mesh.
Line LineOf(const WeldedShape& shape) {
  Line line;
  if (shape.curve) {
    for (size_t i = 0; i < shape.mesh.points.size(); ++i) {
      line.push_back({shape.identity[i], shape.mesh.points[i]});
    }
    return line;
  }
  const std::vector<Chain> borders = BorderOf(shape.mesh);
  FJORD_CHECK(borders.size() == 1 && borders[0].closed, borders.size());
  for (const uint32_t v : borders[0].vertices) {
    line.push_back({shape.identity[v], shape.mesh.points[v]});
  }
  return line;
}

double FromSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length2 = glm::dot(b - a, b - a);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0., 1.) : 0;
  return Length(p - (a + (b - a) * t));
}

// How far the points of `line` lie from `other`, in pixels: each from itself there, and where it is
// not there from the segment between its nearest neighbours that are.
double Beyond(const Line& line, const Line& other, const Vec3& eye) {
  std::map<Identity, Vec3> there;
  for (const LinePoint& point : other) there[point.id] = point.place;
  std::vector<size_t> common;
  for (size_t i = 0; i < line.size(); ++i) {
    if (there.count(line[i].id) > 0) common.push_back(i);
  }
  FJORD_CHECK(common.size() >= 3, common.size());
  double most = 0;
  const auto add = [&](const Vec3& place, double distance) {
    most = std::max(most, distance * kFocal / std::max(.01, Length(place - eye)));
  };
  for (size_t k = 0; k < common.size(); ++k) {
    const size_t from = common[k], to = common[(k + 1) % common.size()];
    const Vec3 a = there[line[from].id], b = there[line[to].id];
    add(a, Length(line[from].place - a));
    for (size_t i = (from + 1) % line.size(); i != to; i = (i + 1) % line.size()) {
      add(line[i].place, FromSegment(line[i].place, a, b));
    }
  }
  return most;
}

double Change(const Line& a, const Line& b, const Vec3& eye) {
  return std::max(Beyond(a, b, eye), Beyond(b, a, eye));
}

struct Flight {
  Vec3 from, to;
  Vec3 At(double t) const { return from + (to - from) * t; }
};
// Over the sea towards the shore, along it, down onto it from above, and through the line's plane.
const Flight kFlights[] = {{{-2.6, -2.2, 1.3}, {.7, .4, .45}},
                           {{2.2, -1.9, .5}, {-1.6, 1.2, .5}},
                           {{.3, -1.2, 3}, {.31, -1.05, .1}},
                           {{1.4, .5, -.3}, {.8, .6, .25}}};

// Halves each of `steps` pieces of the flight towards its larger change until the camera hardly
// moves; the largest change that is left is a jump.
double LargestJump(const Flight& flight, int steps, const std::function<Line(const Vec3&)>& at) {
  double jump = 0;
  for (int step = 0; step < steps; ++step) {
    double t0 = double(step) / steps, t1 = double(step + 1) / steps;
    Line l0 = at(flight.At(t0)), l1 = at(flight.At(t1));
    while (Length(flight.At(t1) - flight.At(t0)) > kSmallestMove) {
      const double t = (t0 + t1) * .5;
      if (t <= t0 || t >= t1) break;
      Line line = at(flight.At(t));
      if (Change(l0, line, flight.At(t)) >= Change(line, l1, flight.At(t))) {
        t1 = t;
        l1 = std::move(line);
      } else {
        t0 = t;
        l0 = std::move(line);
      }
    }
    jump = std::max(jump, Change(l0, l1, flight.At(t0)));
  }
  return jump;
}

struct Form {
  const char* name;
  const char* method;
  Law law;
  Direction direction;
  Variant variant;
  bool surface_coast;
};

void PrintTo(const Form& form, std::ostream* out) { *out << form.name; }

class AdaptiveLinesTest : public ::testing::TestWithParam<Form> {};

TEST_P(AdaptiveLinesTest, S21_NothingJumpsInFlight) {
  const Form& form = GetParam();
  const bool curve = std::string(form.method) == "curve";
  // A surface makes all its inside, too: it is asked coarsely.
  for (const double pixels : {24., 8.}) {
    if (form.surface_coast && pixels < 24) continue;
    for (const Flight& flight : kFlights) {
      size_t fewest = ~size_t{0}, most = 0;
      const double jump = LargestJump(flight, 2, [&](const Vec3& eye) {
        FractalSettings settings = PixelSettings(pixels, kFocal, eye);
        settings.method = form.method;
        settings.split = Split::kAdaptive;
        if (!form.surface_coast) settings.increments = Increments::kMidpoint;
        settings.law = form.law;
        settings.direction = form.direction;
        settings.variant = form.variant;
        settings.coast = form.surface_coast;
        settings.H = form.law == Law::kSimilar ? .75 : .6;
        settings.amplitude = .2;
        Line line = LineOf(Weld(*Prepare(curve ? OutlineCurve() : OutlineMesh(), settings)));
        fewest = std::min(fewest, line.size());
        most = std::max(most, line.size());
        return line;
      });
      EXPECT_LT(jump, .01) << pixels << " pixels";
      EXPECT_GT(most, fewest + fewest / 5) << "the flight changes nothing";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, AdaptiveLinesTest,
    ::testing::Values(
        Form{"curve_perturbed", "curve", Law::kSimilar, Direction::kVertex, Variant::kPerturbed,
             false},
        Form{"curve_current", "curve", Law::kSimilar, Direction::kEdge, Variant::kCurrent, false},
        Form{"curve_fixed", "curve", Law::kAffine, Direction::kEdge, Variant::kFixed, false},
        Form{"curve_printed", "curve", Law::kShih, Direction::kVertex, Variant::kCurrent, false},
        Form{"coast_perturbed", "coast", Law::kSimilar, Direction::kEdge, Variant::kPerturbed,
             false},
        Form{"coast_current", "coast", Law::kSimilar, Direction::kVertex, Variant::kCurrent, false},
        Form{"surface_coast", "surface", Law::kAffine, Direction::kVertex, Variant::kFixed, true}),
    [](const auto& form) { return std::string(form.param.name); });

}  // namespace
}  // namespace fjord::test
