// Split ADAPTIVE is continuous in the camera: however little the camera moves, nothing jumps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

constexpr double kFocal = 600;

// A flat grid whose faces are of several sizes, seen from `eye`.
CoarseShape FlatGrid() {
  CoarseShape shape = Made(MakeGrid(Vec3(4, 4, 0), 5, 4));
  for (size_t i = 0; i < shape.now.size(); ++i) {
    shape.now[i].x += .25 * std::sin(1.7 * static_cast<double>(i));
    shape.now[i].y += .3 * std::cos(2.3 * static_cast<double>(i));
  }
  shape.rest = shape.now;
  return shape;
}

// Heights of the surface over a lattice of places: triangles move along z only.
class Heights : public StreamSink {
 public:
  static constexpr int kSide = 64;
  static Vec2 Place(int i, int j) {
    return {-1.9 + 3.8 * (i + .37) / kSide, -1.9 + 3.8 * (j + .61) / kSide};
  }
  bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }
  void Take(const StreamBatch& batch) override {
    for (const Triangle& t : batch.triangles) {
      Draw(batch.vertices[t[0]].position, batch.vertices[t[1]].position,
           batch.vertices[t[2]].position);
    }
    leaves += batch.triangles.size();
  }

  std::vector<double> height = std::vector<double>(kSide * kSide, 0);
  size_t leaves = 0;

 private:
  void Draw(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = [](double x) {
      return static_cast<int>(std::ceil((x + 1.9) / 3.8 * kSide - .7));
    };
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area <= 0) return;
    const int i0 = std::max(0, first(std::min({a.x, b.x, c.x})));
    const int i1 = std::min(kSide - 1, first(std::max({a.x, b.x, c.x})));
    const int j0 = std::max(0, first(std::min({a.y, b.y, c.y})));
    const int j1 = std::min(kSide - 1, first(std::max({a.y, b.y, c.y})));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        const Vec2 p = Place(i, j);
        const double u = ((p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x)) / area;
        const double v = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        height[static_cast<size_t>(j * kSide + i)] = a.z + u * (b.z - a.z) + v * (c.z - a.z);
      }
    }
  }
};

struct Flight {
  Vec3 from, to;
  Vec3 At(double t) const { return from + (to - from) * t; }
};
const Flight kFlights[] = {{{-2.6, -2.2, 1.3}, {.7, .4, .45}},
                           {{2.2, -1.9, .5}, {-1.6, 1.2, .5}},
                           {{.3, -.2, 3}, {.31, -.17, .4}}};

// The largest change of a height between two places of a flight, in pixels.
double Change(const Heights& a, const Heights& b, const Vec3& eye) {
  double most = 0;
  for (int j = 0; j < Heights::kSide; ++j) {
    for (int i = 0; i < Heights::kSide; ++i) {
      const auto at = static_cast<size_t>(j * Heights::kSide + i);
      const Vec2 p = Heights::Place(i, j);
      const double distance = Length(Vec3(p.x, p.y, 0) - eye);
      most = std::max(most, std::abs(a.height[at] - b.height[at]) * kFocal / distance);
    }
  }
  return most;
}

// Halves each of `steps` pieces of the flight towards its larger change, until the camera moves by
// 1e-12; the largest change that is left is a jump.
double LargestJump(const Flight& flight, int steps, const std::function<Heights(const Vec3&)>& at) {
  double jump = 0;
  for (int step = 0; step < steps; ++step) {
    double t0 = double(step) / steps, t1 = double(step + 1) / steps;
    Heights h0 = at(flight.At(t0)), h1 = at(flight.At(t1));
    while (Length(flight.At(t1) - flight.At(t0)) > 1e-12) {
      const double t = (t0 + t1) * .5;
      if (t <= t0 || t >= t1) break;
      Heights h = at(flight.At(t));
      if (Change(h0, h, flight.At(t)) >= Change(h, h1, flight.At(t))) {
        t1 = t;
        h1 = std::move(h);
      } else {
        t0 = t;
        h0 = std::move(h);
      }
    }
    jump = std::max(jump, Change(h0, h1, flight.At(t0)));
  }
  return jump;
}

TEST(AdaptiveTest, S21_NothingJumpsInFlight) {
  for (const double pixels : {24., 8.}) {
    for (const Flight& flight : kFlights) {
      size_t fewest = ~size_t{0}, most = 0;
      const double jump = LargestJump(flight, 5, [&](const Vec3& eye) {
        FractalSettings settings = PixelSettings(pixels, kFocal, eye);
        settings.split = Split::kAdaptive;
        settings.H = .6;
        settings.amplitude = .3;
        const auto prepared = Prepare(FlatGrid(), settings);
        Heights heights;
        for (size_t root = 0; root < prepared->RootCount(); ++root) {
          prepared->Stream(root, heights, 1024);
        }
        fewest = std::min(fewest, heights.leaves);
        most = std::max(most, heights.leaves);
        return heights;
      });
      EXPECT_LT(jump, .01) << pixels << " pixels";
      EXPECT_GT(most, fewest + fewest / 5) << "the flight changes nothing";
    }
  }
}

}  // namespace
}  // namespace fjord::test
