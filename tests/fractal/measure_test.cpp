#include "engine/fractal/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "engine/fractal/measure_shape.h"

namespace fjord {
namespace {

// The Koch line over 0..1: 4^depth segments of 3^-depth.
Polyline Koch(int depth) {
  Polyline line;
  line.points = {{0, 0, 0}, {1, 0, 0}};
  for (int level = 0; level < depth; ++level) {
    std::vector<Vec3> next;
    for (size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vec3 a = line.points[i];
      const Vec3 third = (line.points[i + 1] - a) / 3.0;
      const Vec3 left(-third.y, third.x, 0);
      next.push_back(a);
      next.push_back(a + third);
      next.push_back(a + third * 1.5 + left * std::sqrt(.75));
      next.push_back(a + third * 2.0);
    }
    next.push_back(line.points.back());
    line.points = next;
  }
  return line;
}

std::vector<double> Powers(double base, int from, int to) {
  std::vector<double> powers;
  for (int k = from; k <= to; ++k) {
    powers.push_back(std::pow(base, k));
  }
  return powers;
}

TEST(MeasureTest, S1_KochByFormula) {
  const double third = 1.0 / 3;
  EXPECT_NEAR(*SimilarityDimension(std::vector<double>(4, third)), 1.261859507, 1e-8);
}

TEST(MeasureTest, S1_KochByRulerCount) {
  const Polyline koch = Koch(7);
  for (int k = 1; k <= 6; ++k) {
    EXPECT_NEAR(CountSteps(koch, std::pow(3, -k)), std::pow(4, k), 1e-3) << k;
  }
  EXPECT_NEAR(RulerDimension(koch, Powers(1.0 / 3, 1, 6)), 1.2619, .02);
  EXPECT_NEAR(RulerDimension(koch, Powers(.7, 4, 16)), 1.2619, .04);
}

TEST(MeasureTest, S1_WholeDimensionsStayWhole) {
  Polyline line;
  line.points = {{0, 0, 0}, {3, 4, 0}};
  EXPECT_NEAR(CountSteps(line, .25), 20, 1e-9);
  EXPECT_NEAR(RulerDimension(line, Powers(.5, 1, 8)), 1, 1e-6);
}

TEST(MeasureTest, G6_SimilarityDimensions) {
  const auto dimension = [](std::vector<double> ratios) { return *SimilarityDimension(ratios); };
  EXPECT_NEAR(dimension({1.0 / 3, 1.0 / 3}), .6309, 1e-4);            // Cantor
  EXPECT_NEAR(dimension({.2, .3, .5}), 1, 1e-12);                     // a paved line
  EXPECT_NEAR(dimension(std::vector<double>(9, 1.0 / 3)), 2, 1e-12);  // a square
  EXPECT_FALSE(SimilarityDimension(std::vector<double>{.5}).has_value());
  EXPECT_FALSE(SimilarityDimension(std::vector<double>{.5, 1.5}).has_value());
  EXPECT_FALSE(SimilarityDimension(std::vector<double>{.5, 0}).has_value());
}

TEST(MeasureTest, G3_BoxCounts) {
  std::vector<Vec3> square;
  std::vector<Vec3> segment;
  for (int i = 0; i < 256; ++i) {
    for (int j = 0; j < 256; ++j) {
      square.push_back({(i + .5) / 256, (j + .5) / 256, 0});
    }
    segment.push_back({(i + .5) / 256, .5 * (i + .5) / 256, 0});
  }
  EXPECT_NEAR(BoxDimension(square, Powers(.5, 1, 6)), 2, .05);
  EXPECT_NEAR(BoxDimension(segment, Powers(.5, 1, 6)), 1, .05);
  EXPECT_NEAR(BoxDimension(Resample(Koch(7), 3e-4), Powers(.5, 2, 8)), 1.26, .06);

  std::vector<Vec3> cantor = {{.5, 0, 0}};  // middles of the intervals, so no box border is met
  double width = 1;
  for (int level = 0; level < 8; ++level, width /= 3) {
    std::vector<Vec3> next;
    for (const Vec3& p : cantor) {
      next.push_back(p - Vec3(width / 3, 0, 0));
      next.push_back(p + Vec3(width / 3, 0, 0));
    }
    cantor = next;
  }
  for (int k = 0; k <= 7; ++k) {
    EXPECT_EQ(CountBoxes(cantor, std::pow(3, -k), Vec3(0)), size_t{1} << k);
  }
}

TEST(MeasureTest, S2_BrownianWalkHasHalf) {
  std::vector<double> walk = {0};
  for (uint64_t i = 0; i < 65536; ++i) {
    walk.push_back(walk.back() + Gaussian(CoarseIdentity(3, i).lo, 4));
  }
  EXPECT_NEAR(*HurstExponent(walk), .5, .02);
  EXPECT_NEAR(*HurstExponent(walk, false), .5, .02);
  std::vector<double> line(100);
  for (size_t i = 0; i < line.size(); ++i) {
    line[i] = static_cast<double>(i);
  }
  EXPECT_NEAR(*HurstExponent(line), 1, 1e-9);
  EXPECT_FALSE(HurstExponent(std::vector<double>(100, 1)).has_value());
  EXPECT_FALSE(HurstExponent(std::vector<double>(20, 1)).has_value());
}

TEST(MeasureTest, S2_AlignedIncrementsAreTheAlignedOnes) {
  const std::vector<double> values = {0, 1, 0, 3, 0};
  EXPECT_EQ(Variogram(values, 2, true), 0);
  EXPECT_EQ(Variogram(values, 2, false), 4.0 / 3);
  EXPECT_EQ(Variogram(values, 1, true), 5);
}

Mesh Box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({i & 1 ? 2 : 0, i & 2 ? 3 : 0, i & 4 ? 4 : 0});
  }
  const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : faces) {
    mesh.AddFace(face);
  }
  return mesh;
}

TEST(MeasureTest, SizesOfKnownShapes) {
  EXPECT_DOUBLE_EQ(MeshArea(Box()), 52);
  EXPECT_DOUBLE_EQ(MeshVolume(Box()), 24);
  Polyline square;
  square.points = {{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}};
  EXPECT_DOUBLE_EQ(LineLength(square), 6);
  square.closed = true;
  EXPECT_DOUBLE_EQ(LineLength(square), 8);
  EXPECT_DOUBLE_EQ(LineArea(square), 4);
  EXPECT_EQ(Resample(square, .6).size(), 17u);
}

TEST(MeasureTest, ShapesAreDescribed) {
  const std::vector<Polyline> curves = {Koch(6)};
  const ShapeMeasure shape = MeasureShape(Box(), curves);
  ASSERT_TRUE(shape.mesh.has_value());
  EXPECT_TRUE(shape.mesh->closed);
  EXPECT_EQ(shape.mesh->euler, 2);
  EXPECT_EQ(shape.mesh->faces, 6u);
  EXPECT_DOUBLE_EQ(shape.mesh->longest_edge, 4);
  EXPECT_DOUBLE_EQ(shape.mesh->shortest_edge, 2);
  EXPECT_NEAR(*shape.curves[0].dimension, 1.26, .04);
  EXPECT_NE(shape.ToText().find("mesh.volume"), std::string::npos);
  EXPECT_NE(shape.ToText().find("curve.1.points"), std::string::npos);
}

// A height field of known roughness, by midpoint displacement over a square grid would be circular:
// a sum of sines of random phase, amplitude 2^(-kH) at frequency 2^k, has the H asked.
TEST(MeasureTest, S2_ReliefMeasuresItsH) {
  for (const double H : {.3, .5, .7}) {
    Mesh mesh;
    constexpr int kSide = 120;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        double z = 0;
        for (int k = -4; k < 7; ++k) {
          for (int wave = 0; wave < 4; ++wave) {
            const double turn = (k * 4 + wave) * 2.39996;
            const double f = 6.28 * std::pow(2, k) / kSide;
            z += std::pow(2, -k * H) *
                 std::sin(f * (i * std::cos(turn) + j * std::sin(turn)) + turn * turn);
          }
        }
        mesh.points.push_back({i * .01, j * .01, z});
      }
    }
    for (uint32_t i = 0; i + 1 < kSide; ++i) {
      for (uint32_t j = 0; j + 1 < kSide; ++j) {
        const uint32_t v = i * kSide + j;
        const uint32_t face[4] = {v, v + kSide, v + kSide + 1, v + 1};
        mesh.AddFace(face);
      }
    }
    const std::optional<double> measured = ReliefHurst(mesh);
    ASSERT_TRUE(measured.has_value());
    EXPECT_NEAR(*measured, H, .1);
  }
}

}  // namespace
}  // namespace fjord
