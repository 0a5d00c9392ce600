// Filled curves against the winding number of the curve itself, worked out in its own plane.
#include "engine/render/build.h"
#include "engine/render/view.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

constexpr Rgb kRed{1, 0, 0};

// How often the closed curve goes round (x, y); all of it lies in z = 0.
int Winding(const std::vector<Vec3>& points, double x, double y) {
  int sum = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 &a = points[i], &b = points[(i + 1) % points.size()];
    if ((a.y <= y) == (b.y <= y)) continue;
    if (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) <= x) sum += a.y < b.y ? 1 : -1;
  }
  return sum;
}

// Is the curve's inside what is seen at picture coordinates px, py (pixels)?
bool ShowsInside(const View& view, const std::vector<Vec3>& points, double px, double py) {
  const Vec3 across = view.right * ((px - view.center_x) / view.focal) +
                      view.up * ((view.center_y - py) / view.focal);
  const Vec3 from = view.orthographic ? view.eye + across : view.eye;
  const Vec3 way = view.orthographic ? view.forward : view.forward + across;
  const double t = -from.z / way.z;
  if (!(t >= view.near)) return false;
  const Vec3 at = from + way * t;
  return Winding(points, at.x, at.y) != 0;
}

// The scene's one object, a closed curve in z = 0, against its winding number; returns how many
// pixels are inside.
int CheckFill(v1::FrameScene scene) {
  scene.mutable_output()->set_samples(1);
  v1::FrameObject* object = scene.mutable_object(0);
  object->set_curve(true);
  object->set_closed(true);
  object->mutable_material()->set_fill(true);
  object->mutable_material()->set_line_width(0);
  const Result<BuiltFrame> built = BuildFrame(scene);
  EXPECT_TRUE(built.ok());
  const Result<WeldedShape> shape = built->objects[0].prepared->Weld({});
  EXPECT_TRUE(shape.ok());
  const View view = MakeView(built->camera, built->width, built->height);
  const Picture picture = Draw(scene);
  int inside = 0, wrong = 0;
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      const auto shows = [&](double dx, double dy) {
        return ShowsInside(view, shape->mesh.points, x + .5 + dx, y + .5 + dy);
      };
      constexpr double kNear = .02;  // pixels: corners are rounded to the grid
      const bool wanted = shows(0, 0);
      if (shows(kNear, kNear) != wanted || shows(-kNear, kNear) != wanted ||
          shows(kNear, -kNear) != wanted || shows(-kNear, -kNear) != wanted) {
        continue;
      }
      inside += wanted;
      wrong += At(picture, x, y).r != (wanted ? 1 : 0);
    }
  }
  EXPECT_EQ(wrong, 0) << "pixels of " << picture.width * picture.height << ", " << inside
                      << " inside";
  const std::string whole = PixelDigest(picture).Hex();
  for (const int tile : {16, 48}) {
    EXPECT_EQ(DigestOf(scene, {.threads = 2, .tile_size = tile}), whole) << "tile " << tile;
  }
  return inside;
}

// A bay, a cape and a bay: no convex shape.
std::vector<Vec3> Lake(double size) {
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) {
    const double turn = i * exact::kPi / 30;
    const double r = size * (1 + .3 * exact::Sin(5 * turn));
    points.emplace_back(r * exact::Cos(turn), r * exact::Sin(turn), 0);
  }
  return points;
}

v1::FrameFractal* MakeShore(v1::FrameObject* object, double epsilon) {
  v1::FrameFractal* fractal = MakeRough(object, epsilon);
  fractal->set_method("curve");
  SetWords(fractal, {{"direction", "EDGE"}, {"variant", "CURRENT"}});
  return fractal;
}

// An orthographic view has no eye to be behind: the near plane cuts what is filled, not its
// outline.
TEST(FillTest, OrthographicOutlinesHaveNoNearPlane) {
  for (const Vec3& up : {Vec3(-1, .2, .4), Vec3(0, 0, 1), Vec3(1, .1, 0)}) {
    v1::FrameScene scene = FlatScene(120, 120);
    v1::FrameCamera* camera = scene.mutable_camera();
    Put(camera->mutable_eye(), {0, -1, .6});
    Put(camera->mutable_up(), {up.x, up.y, up.z});
    camera->set_view_height(9);
    camera->set_near(.01);
    v1::FrameObject* lake = AddObject(&scene, Lake(3.5), {}, kRed);
    EXPECT_GT(CheckFill(scene), 500);
    MakeShore(lake, .1);
    EXPECT_GT(CheckFill(scene), 500);
  }
}

// What a shore may reach is much more than what it does reach: its fill is there all the same, at
// every distance of the eye.
TEST(FillTest, ShoresAreFilledWhereTheyAreBeforeTheEye) {
  for (const double distance : {4.02, 4.019999, 2., .5}) {
    v1::FrameScene scene =
        PerspectiveScene(120, 68, Vec3(.6, -.8, .5) * distance, Vec3(0, 0, 0), 40);
    v1::FrameObject* lake =
        AddObject(&scene, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {}, kRed);
    MakeShore(lake, .02);
    EXPECT_GT(CheckFill(scene), 800) << distance;
  }
}

// A lake round the eye, which looks forward, down, to the side, rolled over to all sides.
TEST(FillTest, FillsAreCutAtTheNearPlane) {
  for (const Vec3& up :
       {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-1, 0, .3), Vec3(.5, 0, 1)}) {
    for (const Vec3& at : {Vec3(0, 3, .4), Vec3(.5, 3, -2), Vec3(0, 3, -9)}) {
      for (const double near : {.01, .5}) {
        v1::FrameScene scene = PerspectiveScene(96, 64, {.2, -.5, .6}, at, 60);
        Put(scene.mutable_camera()->mutable_up(), {up.x, up.y, up.z});
        scene.mutable_camera()->set_near(near);
        MakeShore(AddObject(&scene, Lake(3), {}, kRed), .05);
        EXPECT_GT(CheckFill(scene), 400);
      }
    }
  }
}

// Millions of pixels beyond the picture a shore still goes where it goes.
TEST(FillTest, FillsReachFarBeyondThePicture) {
  v1::FrameScene scene = FlatScene(64, 48);
  AddObject(&scene, {{-3e9, -2.9e9, 0}, {3e9, 2.9e9 + 5, 0}, {-4e9, 1e9, 0}}, {}, kRed);
  EXPECT_GT(CheckFill(scene), 1000);
}

}  // namespace
}  // namespace fjord
