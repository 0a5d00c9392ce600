#include "engine/render/frame_setup.h"

#include <algorithm>
#include <utility>

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
    : frame(built),
      view(MakeView(built.camera, built.width, built.height)),
      exposure{view, built.instant, 0, built.samples} {
  bool places_read = false;
  for (const Light& light : built.lights) {
    ShadeLight shade;
    shade.local = light.local;
    shade.place = light.local ? light.place : Unit(light.place, Vec3(0, 0, 1));
    shade.inverse_range = light.range > 0 ? static_cast<float>(1 / light.range) : 1e30f;
    shade.color = light.color;
    places_read |= light.local || light.shadow > 0;
    lights.push_back(shade);
  }
  HitGeometry geometry;
  geometry.rays = MakeRays(view);
  geometry.eye = view.eye;
  geometry.forward = view.forward;
  geometry.orthographic = view.orthographic;
  geometry.wants_position = places_read;

  const BuiltObject* attributes_of = nullptr;
  std::shared_ptr<const CoarseAttributes> attributes;  // all places of an object share them
  for (const ObjectPlace& place : PlacesSeen(built, view)) {
    const BuiltObject& object = built.objects[place.object];
    const Material& material = object.material;
    ObjectSetup setup;
    Owner owner;
    setup.to = MakeProjection(view, place.transform);
    owner.object = place.object;
    owner.transform = place.transform;
    if (&object != attributes_of) {
      attributes_of = &object;
      attributes = std::make_shared<const CoarseAttributes>(object);
    }
    if (attributes->any()) {
      owner.attributes = attributes;
      setup.keep = Keep::kPlaces;
    }
    setup.fill = FillPlane(view, object, place.transform);
    setup.line_width = material.drawn_width();
    owner.opacity = object.shape->curve ? material.opacity() : 1;
    setup.translucent = owner.opacity < 1;
    double determinant = 0;
    const std::array<double, 9> cofactors = Cofactors(place.transform, &determinant);
    owner.surface.lit = !object.shape->curve;
    owner.surface.diffuse = material.diffuse;
    owner.surface.specular = material.specular;
    owner.surface.shininess = material.shininess;
    owner.surface.ambient = built.ambient * material.ambient;
    owner.surface.normal_matrix = NormalMatrix(cofactors);
    owner.geometry = geometry;
    owner.geometry.wants_position = places_read || (object.texture && !object.texture->empty());
    if (determinant != 0) {
      // last row of the inverse: object z of a world point
      const Vec3 row(cofactors[2] / determinant, cofactors[5] / determinant,
                     cofactors[8] / determinant);
      const Vec3 moved(place.transform[3], place.transform[7], place.transform[11]);
      owner.geometry.height_row = row;
      owner.geometry.height_offset = -glm::dot(row, moved);
    }
    if (!material.ramp.empty()) owner.geometry.height_offset -= material.ramp.front().height;
    objects.push_back(setup);
    owners.push_back(std::move(owner));
    CullObject culled{object.prepared.get(), setup.to};
    if (object.shape->curve) culled.spread = StrokeSpread(setup.line_width);
    if (setup.fill) {
      culled.open = OutlineFill::CountsFrom(*setup.fill);
      culled.before_near = view.orthographic;
    }
    cull.push_back(culled);
  }
  // A sea is there even in frames without one, so that owners are numbered alike.
  Owner water;
  water.kind = OwnerKind::kSea;
  water.grain = Grain::kPixel;
  water.geometry = geometry;
  if (built.sea) {
    sea = MakeViewPlane(view, Vec3(0, 0, built.sea->level), Vec3(0, 0, 1));
    water.surface.specular = built.sea->specular;
    water.surface.shininess = built.sea->shininess;
    water.surface.ambient = built.ambient;
    water.surface.normal_matrix = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  }
  sea_owner = static_cast<uint32_t>(owners.size());
  owners.push_back(water);
  Owner beyond;
  beyond.kind = OwnerKind::kSky;
  beyond.grain = built.alpha || built.sky.kind == SkyKind::kPicture ? Grain::kRow : Grain::kPixel;
  beyond.geometry = geometry;
  sky_owner = static_cast<uint32_t>(owners.size());
  owners.push_back(beyond);
}

}  // namespace fjord
