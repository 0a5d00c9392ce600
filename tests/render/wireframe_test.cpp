#include "engine/render/wireframe.h"

#include <algorithm>

#include "engine/geometry/primitives.h"
#include "engine/render/build.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

BuiltFrame Build(const v1::FrameScene& scene) {
  Result<BuiltFrame> built = BuildFrame(scene);
  EXPECT_TRUE(built.ok()) << (built.ok() ? "" : built.error().message);
  return built.ok() ? *built : BuiltFrame{};
}

v1::FrameScene Hill(double epsilon) {
  v1::FrameScene scene = PerspectiveScene(320, 200, {.3, -2.2, 1.3}, {0, 0, 0}, 40);
  const Result<Mesh> grid = MakeGrid(Vec3(3, 3, 0), 2, 2);
  MakeRough(AddMesh(&scene, *grid, Rgb(1)), epsilon);
  return scene;
}

TEST(WireframeTest, S26_DrawsEveryWeldedEdgeOnce) {
  v1::FrameScene scene = FlatScene(64, 64);
  AddObject(&scene, {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}},
            {{0, 1, 2}, {0, 2, 3}}, Rgb(1));
  const auto drawn = RenderWireframe(Build(scene));
  ASSERT_TRUE(drawn.ok());
  EXPECT_EQ(drawn->stats.edges, 5u);
  EXPECT_EQ(drawn->stats.coarser, 1);
  const auto ink = [&](int x, int y) { return drawn->picture.bytes[3 * (y * 64 + x)]; };
  const uint8_t paper = ink(0, 0);
  EXPECT_GT(ink(12, 32), paper) << "left side";
  EXPECT_GT(ink(40, 52), paper) << "lower side";
  EXPECT_GT(ink(24, 39), paper) << "diagonal";
  EXPECT_EQ(ink(24, 20), paper) << "inside";
}

TEST(WireframeTest, S26_CapsTheEdgesAndSaysSo) {
  const BuiltFrame frame = Build(Hill(.0005));
  const auto drawn = RenderWireframe(frame, 20000);
  ASSERT_TRUE(drawn.ok());
  EXPECT_LE(drawn->stats.edges, 20000u);
  EXPECT_GT(drawn->stats.edges, 2000u);
  EXPECT_GT(drawn->stats.coarser, 1);
  EXPECT_LT(drawn->stats.made, 20 * 20000u) << "it must cost less than the picture";
  const auto svg = WireframeSvg(frame, 20000);
  ASSERT_TRUE(svg.ok());
  EXPECT_EQ(svg->stats.edges, drawn->stats.edges);
  EXPECT_EQ(svg->svg.substr(0, 5), "<svg ");
  EXPECT_LE(std::count(svg->svg.begin(), svg->svg.end(), 'M'),
            static_cast<ptrdiff_t>(svg->stats.edges));
}

TEST(WireframeTest, S26_CoarseShapesBeyondTheCapAreThinnedOut) {
  v1::FrameScene scene = FlatScene(64, 64);
  const Result<Mesh> sphere = MakeEllipsoid(Vec3(24), 60, 40);
  AddMesh(&scene, *sphere, Rgb(1));
  const auto drawn = RenderWireframe(Build(scene), 1000);
  ASSERT_TRUE(drawn.ok());
  EXPECT_LE(drawn->stats.edges, 1000u);
  EXPECT_GT(drawn->stats.edges, 500u);
}

// A camera low over one corner of a large terrain: edges are spent on what is seen of it.
TEST(WireframeTest, SpendsItsEdgesInView) {
  v1::FrameScene scene = PerspectiveScene(320, 200, {-48, -48, 1}, {-47, -44, 0}, 30);
  const Result<Mesh> grid = MakeGrid(Vec3(100, 100, 0), 40, 40);
  MakeRough(AddMesh(&scene, *grid, Rgb(1)), .02);
  const auto drawn = RenderWireframe(Build(scene), 20000);
  ASSERT_TRUE(drawn.ok());
  EXPECT_LE(drawn->stats.edges, 20000u);
  EXPECT_GT(drawn->stats.edges, 4000u) << "the coarse grid has no 50 in view";
  EXPECT_LT(drawn->stats.made, 20 * 20000u);
  const auto svg = WireframeSvg(Build(scene), 20000);
  ASSERT_TRUE(svg.ok());
  EXPECT_EQ(std::count(svg->svg.begin(), svg->svg.end(), 'M'),
            static_cast<ptrdiff_t>(svg->stats.edges))
      << "each edge counted is drawn";
}

// What is left of too many is what is longest on the picture: here the near spokes.
TEST(WireframeTest, TheLongestStay) {
  v1::FrameScene scene = FlatScene(64, 64);
  std::vector<Vec3> points;
  std::vector<std::vector<uint32_t>> faces;
  for (uint32_t i = 0; i < 200; ++i) {
    const double x = -30 + .3 * i, height = i % 10 == 0 ? 50 : .5;
    const auto first = static_cast<uint32_t>(points.size());
    for (const Vec3& p : {Vec3(x, -25, 0), Vec3(x + .1, -25, 0), Vec3(x, -25 + height, 0)}) {
      points.push_back(p);
    }
    faces.push_back({first, first + 1, first + 2});
  }
  AddObject(&scene, points, faces, Rgb(1));
  const auto svg = WireframeSvg(Build(scene), 40);
  ASSERT_TRUE(svg.ok());
  EXPECT_TRUE(svg->stats.longest_only);
  ASSERT_EQ(svg->stats.edges, 40u);
  // Two sides of each of the twenty spokes reach from row 57 to row 7.
  size_t high = 0;
  for (size_t at = 0; (at = svg->svg.find(" 7\n", at)) != std::string::npos; ++at) ++high;
  for (size_t at = 0; (at = svg->svg.find(" 7L", at)) != std::string::npos; ++at) ++high;
  EXPECT_EQ(high, 40u);
}

TEST(WireframeTest, S26_G28_GeometryIsTheSameForEveryLookAtIt) {
  v1::FrameScene scene = Hill(.05);
  const Digest digest = GeometryDigest(Build(scene));
  v1::FrameScene elsewhere = scene;
  Put(elsewhere.mutable_camera()->mutable_eye(), {2, 2, 2});
  elsewhere.mutable_output()->set_width(77);
  EXPECT_EQ(GeometryDigest(Build(elsewhere)), digest);
  scene.mutable_object(0)->mutable_fractal()->set_seed(8);
  EXPECT_NE(GeometryDigest(Build(scene)), digest);
}

}  // namespace
}  // namespace fjord
