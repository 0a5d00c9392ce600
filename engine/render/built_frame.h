// One frame as plain values, ready to draw: what render/build.cpp makes of a frame scene. From here
// on no message is read.
//
// Ownership: everything is held by value or shared; immutable once built and free to share between
// threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/fractal/method.h"
#include "engine/geometry/vec.h"
#include "engine/image/picture.h"
#include "engine/render/haze.h"
#include "engine/render/sky.h"
#include "engine/texture/stage.h"
#include "engine/texture/uv_map.h"

namespace fjord {

struct Camera {
  Vec3 eye{0, -1, 0};
  Vec3 look_at{0};
  Vec3 up{0, 0, 1};
  bool orthographic = false;
  double fov = 40;         // degrees, full vertical angle
  double view_height = 1;  // orthographic: scene units
  double near = .01;       // nothing nearer along the view direction is drawn
};

struct Light {
  bool local = false;
  Vec3 place{0, 0, 1};  // direction towards it (any length), or position
  double range = 1;     // local
  Rgb color{1};
  double shadow = 0;  // directional: width of a texel of its shadow map; 0: nothing is kept from it
};

struct Sea {
  double level = 0;
  Rgb color{0};
  float specular = 0;
  float shininess = 1;
};

struct RampStop {
  double height = 0;  // object z
  Rgb color{0};
};

struct Material {
  Rgb color{.8f};
  float ambient = 1;
  float diffuse = 1;
  float specular = 0;
  float shininess = 1;  // 0: no highlight
  bool smooth = false;  // vertex normals of shapes without a fractal
  bool vertex_color = false;
  std::vector<RampStop> ramp;  // heights ascending; none: color
  double line_width = 1;       // pixels of this picture
  bool fading = false;         // that is less than a pixel: drawn a pixel wide, but translucent
  bool fill = false;           // closed curves

  double drawn_width() const { return fading ? 1 : line_width; }
  float opacity() const { return fading ? static_cast<float>(line_width) : 1; }
};

// Rows of 4: object to world.
using Transform = std::array<double, 12>;
inline constexpr Transform kNoTransform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct BuiltObject {
  std::shared_ptr<const PreparedFractal> prepared;
  // What `prepared` was made from; settings.method is empty for a shape without a fractal.
  std::shared_ptr<const CoarseShape> shape;
  MethodSettings settings;
  Transform transform = kNoTransform;
  std::vector<Transform> placements;  // drawn once at each, before `transform`; none: once
  Material material;
  std::shared_ptr<const TextureChain> texture;  // null: none
  UvMap uv;
};

struct BuiltFrame {
  uint32_t width = 0;
  uint32_t height = 0;
  PixelFormat format = PixelFormat::kPng8;
  uint32_t samples = 4;  // 1, 4 or 16
  bool depth_layer = false;
  bool dither = false;  // kPng8
  bool alpha = false;   // no sky, and a fourth channel
  Camera camera;
  Sky sky;
  Rgb ambient{0};
  std::vector<Light> lights;
  std::optional<Sea> sea;
  std::optional<Haze> haze;
  double instant = 0;  // frames; 0 where no texture stage reads the time
  std::vector<BuiltObject> objects;
};

}  // namespace fjord
