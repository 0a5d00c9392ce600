#include "engine/render/wireframe.h"

#include <algorithm>
#include <chrono>

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
  const auto start = std::chrono::steady_clock::now();
  const auto drawn = RenderWireframe(frame, 20000);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(drawn.ok());
  EXPECT_LE(drawn->stats.edges, 20000u);
  EXPECT_GT(drawn->stats.edges, 2000u);
  EXPECT_GT(drawn->stats.coarser, 1);
  EXPECT_LT(took.count(), 5) << "a second in a release build on an idle machine";
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
