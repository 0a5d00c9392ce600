// Which object every sample shows, worked out from the leaves alone by the rules that
// docs/rendering.md states: no tiles, no culling, no SIMD, every leaf against every sample.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/primitives.h"
#include "engine/render/frame_setup.h"
#include "tests/render/plain_oracle.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

struct Point {
  int64_t x, y;
  double depth;
};

struct Shown {
  double depth = -std::numeric_limits<double>::infinity();
  uint32_t object = kNoHit;
  uint64_t tie = 0;
};

// On an edge p -> q that has the triangle on its right, as seen with y down: does it own what lies
// on it? Left and top edges do.
bool Owns(const Point& p, const Point& q) { return p.y > q.y || (p.y == q.y && q.x > p.x); }

class Oracle {
 public:
  explicit Oracle(const BuiltFrame& frame)
      : setup_(frame),
        places_(SamplePlaces(frame.samples)),
        shown_(size_t{frame.width} * frame.height * places_.size()) {
    for (uint32_t object = 0; object < frame.objects.size(); ++object) {
      Leaves leaves(this, object);
      const PreparedFractal& prepared = *frame.objects[object].prepared;
      for (size_t root = 0; root < prepared.RootCount(); ++root) {
        prepared.Stream(root, leaves, 512);
      }
    }
  }

  // Of samples averaged in their order, flat colours.
  Rgb PixelColor(uint32_t x, uint32_t y) const {
    Rgb sum(0);
    for (size_t s = 0; s < places_.size(); ++s) {
      const Shown& shown = shown_[(size_t{y} * setup_.frame.width + x) * places_.size() + s];
      if (shown.object == kNoHit) continue;
      sum += setup_.frame.objects[shown.object].material.color;
    }
    return sum * (1.f / static_cast<float>(places_.size()));
  }

 private:
  class Leaves final : public StreamSink {
   public:
    Leaves(Oracle* oracle, uint32_t object) : oracle_(oracle), object_(object) {}
    bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }
    void Take(const StreamBatch& batch) override {
      for (const Triangle& t : batch.triangles) {
        oracle_->Add(oracle_->See(object_, batch.vertices[t[0]]),
                     oracle_->See(object_, batch.vertices[t[1]]),
                     oracle_->See(object_, batch.vertices[t[2]]), object_,
                     batch.vertices[t[0]].id + batch.vertices[t[1]].id + batch.vertices[t[2]].id);
      }
      for (const auto& [a, b] : batch.segments) {
        oracle_->AddStroke(batch.vertices[a], batch.vertices[b], object_);
      }
    }

   private:
    Oracle* oracle_;
    uint32_t object_;
  };

  // All of the scene lies before the near plane and within the guard.
  Point See(uint32_t object, const StreamVertex& vertex) const {
    const Projection& to = setup_.objects[object].to;
    const ScreenPoint at = ToScreen(to, ToClip(to, vertex.position));
    return {at.x, at.y, at.depth};
  }

  void Add(Point a, Point b, Point c, uint32_t object, uint64_t tie) {
    // The smallest (x, y) leads; then clockwise on the picture.
    const auto before = [](const Point& p, const Point& q) {
      return p.x != q.x ? p.x < q.x : p.y < q.y;
    };
    while (before(b, a) || before(c, a)) {
      const Point first = a;
      a = b;
      b = c;
      c = first;
    }
    const double bx = static_cast<double>(b.x - a.x), by = static_cast<double>(b.y - a.y);
    const double cx = static_cast<double>(c.x - a.x), cy = static_cast<double>(c.y - a.y);
    const double area = bx * cy - cx * by;
    if (area == 0) return;
    const double db = b.depth - a.depth, dc = c.depth - a.depth;
    const double along_x = (db * cy - dc * by) * (1 / area);
    const double along_y = (dc * bx - db * cx) * (1 / area);
    const double least = std::min({a.depth, b.depth, c.depth});
    const double most = std::max({a.depth, b.depth, c.depth});
    const Point corner[3] = {a, area > 0 ? b : c, area > 0 ? c : b};
    const auto covers = [&](int64_t x, int64_t y) {
      for (int k = 0; k < 3; ++k) {
        const Point &p = corner[k], &q = corner[(k + 1) % 3];
        const int64_t side = (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
        if (side < 0 || (side == 0 && !Owns(p, q))) return false;
      }
      return true;
    };
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const int64_t width = setup_.frame.width, height = setup_.frame.height;
    for (int64_t py = std::max<int64_t>(top / 256 - 1, 0); py < std::min(height, bottom / 256 + 1);
         ++py) {
      for (int64_t px = std::max<int64_t>(left / 256 - 1, 0); px < std::min(width, right / 256 + 1);
           ++px) {
        for (size_t s = 0; s < places_.size(); ++s) {
          const int64_t x = px * 256 + places_[s].x, y = py * 256 + places_[s].y;
          if (!covers(x, y)) continue;
          const double depth = (a.depth + along_x * static_cast<double>(x - a.x)) +
                               along_y * static_cast<double>(y - a.y);
          const auto at = static_cast<size_t>((py * width + px)) * places_.size() + s;
          Keep({std::min(std::max(depth, least), most), object, tie}, &shown_[at]);
        }
      }
    }
  }

  static void Keep(const Shown& now, Shown* there) {
    const bool first =
        now.object != there->object ? now.object < there->object : now.tie < there->tie;
    if (now.depth > there->depth || (now.depth == there->depth && first)) *there = now;
  }

  // A rectangle round the line, half a width longer at both ends.
  void AddStroke(const StreamVertex& a, const StreamVertex& b, uint32_t object) {
    const Projection& to = setup_.objects[object].to;
    const double half = setup_.objects[object].line_width * 128;
    if (half == 0) return;
    const ClipPoint p = ToClip(to, a.position), q = ToClip(to, b.position);
    const double by_p = to.orthographic ? 1 : 1 / p.z, by_q = to.orthographic ? 1 : 1 / q.z;
    const double px = p.x * by_p, py = p.y * by_p, qx = q.x * by_q, qy = q.y * by_q;
    const double length = std::sqrt((qx - px) * (qx - px) + (qy - py) * (qy - py));
    const double ux = length > 0 ? (qx - px) / length * half : half;
    const double uy = length > 0 ? (qy - py) / length * half : 0;
    const auto round = [](double v) { return static_cast<int64_t>(std::floor(v + .5)); };
    const double depth_p = to.orthographic ? -p.z : by_p, depth_q = to.orthographic ? -q.z : by_q;
    const Point corner[4] = {{round(px - ux + uy), round(py - uy - ux), depth_p},
                             {round(qx + ux + uy), round(qy + uy - ux), depth_q},
                             {round(qx + ux - uy), round(qy + uy + ux), depth_q},
                             {round(px - ux - uy), round(py - uy + ux), depth_p}};
    Add(corner[0], corner[1], corner[2], object, a.id + b.id);
    Add(corner[0], corner[2], corner[3], object, a.id + b.id);
  }

  const FrameSetup setup_;
  const std::span<const SamplePlace> places_;
  std::vector<Shown> shown_;
};

// Flat colours, every size of triangle and stroke, cutting through one another.
v1::FrameScene Crossing(bool orthographic, uint32_t samples) {
  v1::FrameScene scene = PerspectiveScene(160, 96, {.2, -4, 1.6}, {0, 0, 0}, 35);
  v1::FrameCamera* camera = scene.mutable_camera();
  camera->set_orthographic(orthographic);
  camera->set_view_height(2.4);
  scene.mutable_output()->set_samples(samples);
  const Result<Mesh> grid = MakeGrid(Vec3(3, 3, 0), 2, 2);
  MakeRough(AddMesh(&scene, *grid, {.5f, .25f, .125f}), .02, .3);  // micro-triangles
  MakeRough(AddMesh(&scene, *grid, {.125f, .5f, .25f}), .07, .4);  // some pixels
  const Result<Mesh> ball = MakeEllipsoid(Vec3(.6), 12, 8);
  AddMesh(&scene, *ball, {.75f, 0, 0});
  AddObject(&scene,
            {{-9, .2, -3}, {9, .4, -3}, {0, .3, .6}, {-1, -1, -.2}, {1, -1, .3}, {0, 1, .1}},
            {{0, 1, 2}, {3, 4, 5}}, {0, 0, .75f});  // large ones
  const std::vector<Vec3> way = {{-1, -1, .4}, {-.2, .4, .9}, {.6, -.9, .3}, {1.2, .5, .6}};
  float blue = 1;
  for (const double width : {1., 3.5, 25.}) {
    v1::FrameObject* line = AddObject(&scene, way, {}, {1, 1, blue *= .5f});
    line->set_curve(true);
    line->mutable_material()->set_line_width(width);
    v1::FrameFractal* fractal = MakeRoughLine(line, .05);
    fractal->set_seed(static_cast<uint64_t>(width));
  }
  return scene;
}

TEST(CoverageOracleTest, D3_EverySampleShowsWhatTheLeavesSay) {
  for (const bool orthographic : {false, true}) {
    for (const uint32_t samples : {1u, 4u, 16u}) {
      const Result<BuiltFrame> built = BuildFrame(Crossing(orthographic, samples));
      ASSERT_TRUE(built.ok());
      const Oracle oracle(*built);
      const Picture picture = DrawBuilt(*built, {.threads = 2, .tile_size = 64}).picture;
      int wrong = 0, filled = 0;
      for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x) {
          const Rgb wanted = oracle.PixelColor(x, y);
          filled += wanted != Rgb(0);
          wrong += At(picture, x, y) != wanted;
        }
      }
      EXPECT_EQ(wrong, 0) << samples << " samples, orthographic " << orthographic;
      EXPECT_GT(filled, 5000);
    }
  }
}

}  // namespace
}  // namespace fjord
