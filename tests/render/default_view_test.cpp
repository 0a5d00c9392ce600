// The camera that a scene gets without asking has all of every frame in view, fractal detail
// included, and does not stand needlessly far away.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/animation/inbetween.h"
#include "engine/render/build.h"
#include "engine/render/view.h"
#include "engine/scene/load.h"
#include "tests/render/random_scenes.h"

namespace fjord {
namespace {

std::shared_ptr<const Animation> AnimationOf(const std::string& text) {
  const AssetReader none = [](const v1::File&) -> Result<std::string> {
    return Invalid("no files");
  };
  LoadResult loaded = LoadSceneText(text, "test.scene", none);
  EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.errors[0].ToString()) << text;
  if (!loaded.ok()) return nullptr;
  auto animation = Animation::Make(std::move(loaded.loaded));
  EXPECT_TRUE(animation.ok());
  return animation.ok() ? *animation : nullptr;
}

// The least rectangle round all vertices of a frame, as parts of the picture: -1..1 is all of it.
struct Extent {
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
  bool before_eye = true;

  void Add(const Extent& other) {
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    top = std::min(top, other.top);
    bottom = std::max(bottom, other.bottom);
    before_eye = before_eye && other.before_eye;
  }
  bool InView() const { return before_eye && left >= -1 && right <= 1 && top >= -1 && bottom <= 1; }
  // Of the side that is filled more.
  double Fills() const { return .5 * std::max(right - left, bottom - top); }
};

enum class Of { kCoarse, kFractal };

Extent ExtentOf(const BuiltFrame& frame, Of of) {
  const View view = MakeView(frame.camera, frame.width, frame.height);
  Extent extent;
  for (const BuiltObject& object : frame.objects) {
    const Projection to = MakeProjection(view, object.transform);
    std::vector<Vec3> points = object.shape->now;
    if (of == Of::kFractal) {
      const Result<WeldedShape> shape = object.prepared->Weld({.details = false});
      EXPECT_TRUE(shape.ok());
      if (shape.ok()) points = shape->mesh.points;
    }
    for (const Vec3& point : points) {
      const ClipPoint at = ToClip(to, point);
      extent.before_eye = extent.before_eye && (to.orthographic || at.z > to.near);
      const double scale = to.orthographic ? 1 : 1 / at.z;
      const double x = at.x * scale / kFixedOne / frame.width * 2 - 1;
      const double y = at.y * scale / kFixedOne / frame.height * 2 - 1;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  }
  return extent;
}

Extent ExtentOfShot(const std::string& text, Of of) {
  Extent extent;
  const auto animation = AnimationOf(text);
  if (animation == nullptr) return extent;
  for (uint32_t frame = 1; frame <= animation->last_frame(); ++frame) {
    AssetSet assets;
    const auto scene = animation->Inbetween(frame, &assets);
    EXPECT_TRUE(scene.ok());
    const auto built = BuildFrame(*scene, &assets);
    EXPECT_TRUE(built.ok());
    if (built.ok()) extent.Add(ExtentOf(*built, of));
  }
  return extent;
}

std::string Number(double value) { return std::to_string(value); }

std::string PointText(const Vec3& p) {
  return "point { x: " + Number(p.x) + " y: " + Number(p.y) + " z: " + Number(p.z) + " } ";
}

// A polygon round the origin, or a line, of one height or of several.
std::string SomeOutline(bool closed, double size) {
  std::string text = "shape { polyline { ";
  const int count = *rc::gen::inRange(3, 8);
  const bool flat = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count, radius = size * Between(.4, 1);
    text += PointText(
        {radius * std::cos(angle), radius * std::sin(angle), flat ? 0 : size * Between(-.3, .3)});
  }
  return text + (closed ? "closed: true } }" : "} }");
}

std::string SomeShape(double size) {
  const std::string s = Number(size);
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return SomeOutline(true, size);
    case 1:
      return SomeOutline(false, size);
    case 2:
      return "shape { primitive { kind: SPHERE radius: " + s + " } }";
    case 3:
      return "shape { primitive { kind: GRID size { x: " + s + " y: " + s + " } } }";
    default:  // a pyramid without a floor, or a flat polygon of triangles
      const double top = OneOf({1., 0.}) * size;
      return "shape { mesh { " + PointText({-size, -size, 0}) + PointText({size, -size, 0}) +
             PointText({size, size, 0}) + PointText({-size, size, 0}) + PointText({0, 0, top}) +
             "face { v: [1, 2, 5] } face { v: [2, 3, 5] } face { v: [3, 4, 5] } "
             "face { v: [4, 1, 5] } } }";
  }
}

RC_GTEST_PROP(DefaultViewProperty, HasAllOfTheFractalInView, ()) {
  const double size = OneOf({1., 3., .3, 20.});
  std::string text = "output { width: 160 height: 100 samples: 1 } objects { name: \"o\" " +
                     SomeShape(size) +
                     " fractal { seed: " + std::to_string(*rc::gen::inRange(1, 1000)) +
                     " H: " + Number(Between(.3, .95)) + " } ";
  if (*rc::gen::arbitrary<bool>()) {
    text += "transform { rotate { x: " + Number(Between(-90, 90)) +
            " z: " + Number(Between(0, 360)) + " } scale { x: 2 y: 1.5 z: 1 } } ";
  }
  text += "} ";
  if (*rc::gen::arbitrary<bool>()) text += "camera { projection: ORTHOGRAPHIC } ";
  if (*rc::gen::arbitrary<bool>()) {
    text +=
        "track { path: \"objects[o].fractal.H\" key { frame: 1 value: 0.9 } "
        "key { frame: 3 value: 0.4 } } ";
  }
  RC_LOG() << text << '\n';
  const Extent fractal = ExtentOfShot(text, Of::kFractal);
  RC_LOG() << fractal.left << ".." << fractal.right << ' ' << fractal.top << ".." << fractal.bottom;
  RC_ASSERT(fractal.InView());
  RC_ASSERT(fractal.Fills() > .3);
}

// An outline between keys that bends far out at its middle key.
TEST(DefaultViewTest, SeesEveryKeyOfAShot) {
  const std::string square =
      "point { x: -1 y: -1 } point { x: 1 y: -1 } point { x: 1 y: 1 } point { x: -1 y: 1 } closed: "
      "true";
  const std::string wide =
      "point { x: -1 y: -1 } point { x: 9 y: -1 } point { x: 9 y: 1 } point { x: -1 y: 1 } closed: "
      "true";
  const std::string text =
      "output { width: 160 height: 100 } objects { "
      "key { frame: 1 shape { polyline { " +
      square + " } } } key { frame: 3 shape { polyline { " + wide +
      " } } } key { frame: 5 shape { polyline { " + square +
      " } } } "
      "fractal { H: 0.5 seed: 7 } }";
  EXPECT_TRUE(ExtentOfShot(text, Of::kFractal).InView());
}

// With the amounts that are defaults, a shape of ordinary size keeps most of the picture.
TEST(DefaultViewTest, TheCoarseShapeFillsMoreThanHalf) {
  for (const char* shape : {"shape { primitive { kind: GRID } } fractal {}",
                            "shape { primitive { kind: SPHERE } } fractal {}",
                            "shape { polyline { closed: true point { x: -1 y: -1 } point { x: 1 y: "
                            "-1 } point { x: 1 y: 1 } "
                            "point { x: -1 y: 1 } } } fractal {} material { fill: true }",
                            "shape { polyline { point { x: -2 } point { x: 2 } } } fractal {}",
                            "shape { mesh { point { x: -1 y: -1 } point { x: 1 y: -1 } point { y: "
                            "1 } face { v: [1, 2, 3] } } } "
                            "fractal {}"}) {
    const std::string text =
        std::string("output { width: 160 height: 100 } objects { ") + shape + " }";
    const double coarse = ExtentOfShot(text, Of::kCoarse).Fills();
    EXPECT_GT(coarse, .5) << shape;
    EXPECT_LE(ExtentOfShot(text, Of::kFractal).Fills(), 1) << shape;
  }
}

}  // namespace
}  // namespace fjord
