// EVEN's reliefs have no direction and do not show the lines of their coarse shape: variances of
// steps and second differences on a flat grid, against those of plain halving.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

constexpr int kCells = 4;              // of the coarse grid, of side 1
constexpr int kFine = 32;              // steps of the fine lattice in a cell
constexpr int kSide = kCells * kFine;  // steps of the lattice
constexpr double kStep = 1. / kFine;

// Means of squares, each over what fBm of this H would have: 1 is right.
struct Steps {
  double old_rows = 0, odd_rows = 0;  // along x, in rows that were there a level before or not
  double rising = 0, falling = 0;     // along both diagonals
  double crease = 0;  // second differences across lines of the coarse grid against the newest
};

double Square(double x) { return x * x; }

struct Mean {
  double sum = 0;
  double count = 0;
  void Add(double x) {
    sum += x;
    count += 1;
  }
  double Value() const { return sum / count; }
};

// `one_way`: all diagonals of the coarse grid run the same way.
Steps StepsOf(double H, Increments increments, Split split, bool one_way) {
  CoarseShape grid = Made(MakeGrid(Vec3(kCells, kCells, 0), kCells, kCells));
  if (one_way) {
    grid.triangles.clear();
    const auto at = [](uint32_t i, uint32_t j) { return j * (kCells + 1) + i; };
    for (uint32_t j = 0; j < kCells; ++j) {
      for (uint32_t i = 0; i < kCells; ++i) {
        grid.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        grid.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  Mean old_rows, odd_rows, rising, falling, across, newest;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    FractalSettings settings = SurfaceSettings(kStep * 1.2);
    settings.increments = increments;
    settings.split = split;
    if (split == Split::kAdaptive) {
      settings.max_level = 6;
      settings.fineness.epsilon = kStep * .1;
    }
    settings.H = H;
    settings.amplitude = 1;
    settings.direction = Direction::kUp;
    settings.seed = seed;
    const WeldedShape welded = Weld(*Prepare(grid, settings));
    std::vector<double> z((kSide + 1) * (kSide + 1), NAN);
    for (const Vec3& p : welded.mesh.points) {
      const double i = (p.x + .5 * kCells) * kFine, j = (p.y + .5 * kCells) * kFine;
      if (i != std::floor(i) || j != std::floor(j)) continue;
      z[static_cast<size_t>(j) * (kSide + 1) + static_cast<size_t>(i)] = p.z;
    }
    const auto at = [&](int i, int j) { return z[static_cast<size_t>(j * (kSide + 1) + i)]; };
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        (j % 2 == 0 ? old_rows : odd_rows).Add(Square(at(i + 1, j) - at(i, j)));
        rising.Add(Square(at(i + 1, j + 1) - at(i, j)));
        falling.Add(Square(at(i + 1, j) - at(i, j + 1)));
        if (i == 0) continue;
        const double bend = Square(at(i + 1, j) - 2 * at(i, j) + at(i - 1, j));
        if (i % kFine == 0) across.Add(bend);
        if (i % 2 == 1) newest.Add(bend);
      }
    }
  }
  const double along = std::pow(kStep, 2 * H), slanting = std::pow(kStep * std::sqrt(2.), 2 * H);
  return {old_rows.Value() / along, odd_rows.Value() / along, rising.Value() / slanting,
          falling.Value() / slanting, across.Value() / newest.Value()};
}

class SurfaceEvenTest : public ::testing::TestWithParam<Split> {};

TEST_P(SurfaceEvenTest, S18_S23_NoDirectionAndNoOldLineShows) {
  for (const bool one_way : {false, true}) {
    for (const double H : {.3, .5, .8}) {
      const Steps even = StepsOf(H, Increments::kEven, GetParam(), one_way);
      EXPECT_NEAR(even.rising / even.falling, 1, .05) << H << ' ' << one_way;
      EXPECT_NEAR(even.odd_rows / even.old_rows, 1.1, .08) << H << ' ' << one_way;
      for (const double mean : {even.old_rows, even.odd_rows, even.rising, even.falling}) {
        EXPECT_NEAR(mean, 1.05, .26) << H << ' ' << one_way;
      }
      EXPECT_NEAR(even.crease, H > .7 ? 1.35 : .95, .12) << H << ' ' << one_way;
    }
  }
}

// What these measures say of plain halving, which stays for the pictures of 1989.
TEST_P(SurfaceEvenTest, S18_S23_PlainHalvingShowsBoth) {
  for (const double H : {.5, .8}) {
    const Steps plain = StepsOf(H, Increments::kMidpoint, GetParam(), true);
    EXPECT_GT(plain.falling / plain.rising, 1.55) << H;
    EXPECT_GT(plain.odd_rows / plain.old_rows, 1.3) << H;
    EXPECT_GT(plain.crease, H > .7 ? 1.45 : 1.08) << H;
  }
}

// An edge of three triangles, and one along which two run the same way, belong to no pair of
// triangles; all of them still make the same points on it.
TEST(SurfaceEvenSeamsTest, S4_OddEdgesStayClosed) {
  CoarseShape fan = Roof();
  fan.now.push_back({.6, .5, 1.1});
  fan.rest = fan.now;
  fan.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 2, 4}};
  CoarseShape turned = Roof();
  turned.triangles = {{0, 1, 2}, {1, 2, 3}};
  for (const CoarseShape& shape : {fan, turned}) {
    const auto prepared = Prepare(shape, SurfaceSettings(.04));
    const Seams seams = SeamsOf(StreamedLeaves(*prepared));
    EXPECT_EQ(seams.single, BorderPieces(shape, .04));
    EXPECT_GT(StreamedLeaves(*prepared).size(), 500u);
  }
}

INSTANTIATE_TEST_SUITE_P(Splits, SurfaceEvenTest,
                         ::testing::Values(Split::kShot, Split::kAdaptive));

}  // namespace
}  // namespace fjord::test
