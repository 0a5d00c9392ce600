#include "engine/render/coarse_attributes.h"

#include "engine/geometry/normals.h"

namespace fjord {
namespace {

Vec3 At(const std::vector<Vec3>& values, const Triangle& corners, const Weights& weight) {
  return (values[corners[0]] * weight.x + values[corners[1]] * weight.y) +
         values[corners[2]] * weight.z;
}

// The direction in the triangle now that was `rest_way` in its rest pose: the part of it that lies
// in the triangle, by the triangle's own sides. 0 for a triangle without area.
Vec3 Carry(const CoarseShape& shape, const Triangle& corners, const Vec3& rest_way) {
  const Vec3 a = shape.rest[corners[1]] - shape.rest[corners[0]];
  const Vec3 b = shape.rest[corners[2]] - shape.rest[corners[0]];
  const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
  const double area2 = aa * bb - ab * ab;
  if (!(area2 > 0)) return Vec3(0);
  const double wa = glm::dot(rest_way, a), wb = glm::dot(rest_way, b);
  const Vec3 now_a = shape.now[corners[1]] - shape.now[corners[0]];
  const Vec3 now_b = shape.now[corners[2]] - shape.now[corners[0]];
  return Unit(now_a * ((wa * bb - wb * ab) / area2) + now_b * ((wb * aa - wa * ab) / area2),
              Vec3(0));
}

}  // namespace

HitPlace FindPlace(const TileBuffer& tile, const SurfaceHits& hits, size_t i) {
  const uint32_t index = tile.record(hits.record[i]).corners;
  if (index == kNoCorners) return {};
  const CornerPlaces& c = tile.corners(index);
  // Exact edge functions of the sample as weights, each times its corner's 1 / w.
  double weight[3];
  for (int k = 0; k < 3; ++k) {
    const int p = (k + 1) % 3, q = (k + 2) % 3;  // the edge opposite corner k
    const double ex = c.x[q] - double{1} * c.x[p], ey = c.y[q] - double{1} * c.y[p];
    const double area = ex * (hits.y[i] - c.y[p]) - ey * (hits.x[i] - c.x[p]);
    weight[k] = area * c.weight[k];
  }
  const double inverse = 1 / ((weight[0] + weight[1]) + weight[2]);
  double second = 0, third = 0;
  for (int k = 0; k < 3; ++k) {
    const double w = weight[k] * inverse;
    second += c.second[k] * w;
    third += c.third[k] * w;
  }
  return {Weights((1 - second) - third, second, third), c.element};
}

CoarseAttributes::CoarseAttributes(const BuiltObject& object)
    : prepared_(object.prepared), shape_(object.shape), map_(object.uv) {
  if (shape_->heights) return;  // no coarse vertices: stages read positions alone
  const Material& material = object.material;
  if (material.smooth && object.settings.method.empty() && !shape_->curve) {
    normals_ = VertexNormals(shape_->now, shape_->triangles);
  }
  colors_ = material.vertex_color && !shape_->colors.empty();
  if (object.texture) {
    rest_ = object.texture->reads().rest;
    uv_ = object.texture->reads().uv && map_.kind != UvKind::kNone;
  }
}

void CoarseAttributes::Apply(std::span<const HitPlace> places, SurfaceHits* hits) const {
  if (normals_.empty() && !colors_) return;
  for (size_t i = 0; i < places.size(); ++i) {
    if (places[i].element == kNoHit) continue;
    const Triangle corners = prepared_->Corners(places[i].element);
    const Weights& weight = places[i].weight;
    if (!normals_.empty()) {
      const Vec3 normal = At(normals_, corners, weight);
      for (int k = 0; k < 3; ++k) hits->normal[k][i] = static_cast<float>(normal[k]);
    }
    for (int k = 0; colors_ && k < 3; ++k) {
      const auto channel = [&](size_t corner) {
        return static_cast<double>(shape_->colors[corners[corner]][k]);
      };
      hits->color[k][i] = static_cast<float>((channel(0) * weight.x + channel(1) * weight.y) +
                                             channel(2) * weight.z);
    }
  }
}

void CoarseAttributes::Apply(std::span<const HitPlace> places,
                             std::span<SurfaceSample> samples) const {
  if (!rest_ && !uv_) return;
  for (size_t i = 0; i < places.size(); ++i) {
    SurfaceSample& sample = samples[i];
    if (places[i].element == kNoHit) continue;
    const Triangle corners = prepared_->Corners(places[i].element);
    sample.rest = At(shape_->rest, corners, places[i].weight);
    if (!uv_) continue;
    const UvPoint at = MapUv(map_, sample.rest);
    sample.u = at.u;
    sample.v = at.v;
    sample.tangent = Carry(*shape_, corners, at.along_u);
  }
}

}  // namespace fjord
