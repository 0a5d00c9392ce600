#include "engine/render/frame_setup.h"

#include <algorithm>

#include "engine/render/outline_fill.h"
#include "engine/render/places.h"

namespace fjord {
namespace {

double Size(double v) { return v < 0 ? -v : v; }

// Cofactors of the 3x3 part: how area vectors turn. Scaled to a largest entry of 1; the identity
// for a transform that flattens everything.
std::array<double, 9> Cofactors(const Transform& m, double* determinant) {
  const Vec3 r0(m[0], m[1], m[2]), r1(m[4], m[5], m[6]), r2(m[8], m[9], m[10]);
  const Vec3 c0 = glm::cross(r1, r2), c1 = glm::cross(r2, r0), c2 = glm::cross(r0, r1);
  *determinant = glm::dot(r0, c0);
  return {c0.x, c0.y, c0.z, c1.x, c1.y, c1.z, c2.x, c2.y, c2.z};
}

std::array<float, 9> NormalMatrix(const std::array<double, 9>& cofactors) {
  double largest = 0;
  for (const double c : cofactors) largest = std::max(largest, Size(c));
  std::array<float, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  if (largest > 0) {
    for (int i = 0; i < 9; ++i) matrix[i] = static_cast<float>(cofactors[i] / largest);
  }
  return matrix;
}

// The plane of a closed coarse curve: its mean place and its area vector (Newell). None for curves
// that are not filled or have no area.
std::optional<ViewPlane> FillPlane(const View& view, const BuiltObject& object,
                                   const Transform& transform) {
  const CoarseShape& shape = *object.shape;
  if (!object.material.fill || !shape.curve || !shape.closed || shape.now.size() < 3) {
    return std::nullopt;
  }
  Vec3 mean(0), area(0);
  for (const Vec3& p : shape.now) mean += p;
  mean = mean * (1. / static_cast<double>(shape.now.size()));
  for (size_t i = 0; i < shape.now.size(); ++i) {
    area += glm::cross(shape.now[i] - mean, shape.now[(i + 1) % shape.now.size()] - mean);
  }
  double determinant = 0;
  const std::array<double, 9> c = Cofactors(transform, &determinant);
  const Vec3 normal(glm::dot(Vec3(c[0], c[1], c[2]), area), glm::dot(Vec3(c[3], c[4], c[5]), area),
                    glm::dot(Vec3(c[6], c[7], c[8]), area));
  return MakeViewPlane(view, Apply(transform, mean), Unit(normal));
}

}  // namespace

FrameSetup::FrameSetup(const BuiltFrame& built)
    : frame(built), view(MakeView(built.camera, built.width, built.height)) {
  bool any_local = false;
  for (const Light& light : built.lights) {
    ShadeLight shade;
    shade.local = light.local;
    shade.place = light.local ? light.place : Unit(light.place, Vec3(0, 0, 1));
    shade.inverse_range = light.range > 0 ? static_cast<float>(1 / light.range) : 1e30f;
    shade.color = light.color;
    any_local |= light.local;
    lights.push_back(shade);
  }
  HitGeometry geometry;
  geometry.rays = MakeRays(view);
  geometry.eye = view.eye;
  geometry.forward = view.forward;
  geometry.orthographic = view.orthographic;
  geometry.wants_position = any_local;

  for (const ObjectPlace& place : PlacesSeen(built, view)) {
    const BuiltObject& object = built.objects[place.object];
    const Material& material = object.material;
    ObjectSetup setup;
    setup.object = place.object;
    setup.to = MakeProjection(view, place.transform);
    setup.attributes.normals = material.smooth && object.settings.method.empty();
    setup.attributes.colors = material.vertex_color && !object.shape->colors.empty();
    setup.line_width = material.line_width;
    double determinant = 0;
    const std::array<double, 9> cofactors = Cofactors(place.transform, &determinant);
    setup.surface.lit = !object.shape->curve;
    setup.surface.diffuse = material.diffuse;
    setup.surface.specular = material.specular;
    setup.surface.shininess = material.shininess;
    setup.surface.ambient = built.ambient * material.ambient;
    setup.surface.normal_matrix = NormalMatrix(cofactors);
    setup.geometry = geometry;
    setup.geometry.wants_position = any_local || (object.texture && !object.texture->empty());
    if (determinant != 0) {
      // last row of the inverse: object z of a world point
      const Vec3 row(cofactors[2] / determinant, cofactors[5] / determinant,
                     cofactors[8] / determinant);
      const Vec3 moved(place.transform[3], place.transform[7], place.transform[11]);
      setup.geometry.height_row = row;
      setup.geometry.height_offset = -glm::dot(row, moved);
    }
    if (!material.ramp.empty()) setup.geometry.height_offset -= material.ramp.front().height;
    setup.fill = FillPlane(view, object, place.transform);
    objects.push_back(setup);
    CullObject culled{object.prepared.get(), setup.to};
    if (object.shape->curve) culled.spread = StrokeSpread(material.line_width);
    if (setup.fill) {
      culled.open = OutlineFill::CountsFrom(*setup.fill);
      culled.before_near = view.orthographic;
    }
    cull.push_back(culled);
  }
  if (built.sea) {
    sea = MakeViewPlane(view, Vec3(0, 0, built.sea->level), Vec3(0, 0, 1));
    sea_surface.specular = built.sea->specular;
    sea_surface.shininess = built.sea->shininess;
    sea_surface.ambient = built.ambient;
    sea_surface.normal_matrix = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  }
  sea_geometry = geometry;
}

}  // namespace fjord
