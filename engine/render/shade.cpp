#include "engine/render/shade.h"

#include <algorithm>

#include "engine/base/clamp.h"
#include "engine/base/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/shade.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"
// after highway.h: compiled per target
#include "engine/base/exact_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::ScalableTag<float>;
using F64 = hn::ScalableTag<double>;
using Half = hn::Rebind<float, F64>;  // as many floats as there are doubles in a vector
using V = hn::Vec<F32>;

HWY_INLINE V Positive(F32 d, V v) { return hn::IfThenElseZero(hn::Gt(v, hn::Zero(d)), v); }

struct V3 {
  V x, y, z;
};
HWY_INLINE V Dot(V3 a, V3 b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 Scale(V3 a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
// 1 / sqrt(v), 0 where v is 0.
HWY_INLINE V InverseRoot(F32 d, V v) {
  const V some = hn::IfThenElse(hn::Gt(v, hn::Zero(d)), v, hn::Set(d, 1.f));
  return hn::IfThenElseZero(hn::Gt(v, hn::Zero(d)), hn::Div(hn::Set(d, 1.f), hn::Sqrt(some)));
}
HWY_INLINE V3 Normalize(F32 d, V3 a) { return Scale(a, InverseRoot(d, Dot(a, a))); }

// base^exponent for base in 0..1: repeated squaring for whole exponents, the exact power otherwise.
HWY_INLINE V Highlight(F32 d, V base, float exponent) {
  const int32_t whole = exponent < 1024 ? ClampToInt32(exponent) : 0;
  if (static_cast<float>(whole) == exponent) {
    V result = hn::Set(d, 1.f);
    V square = base;
    for (int32_t n = whole; n != 0; n >>= 1) {
      if (n & 1) result = hn::Mul(result, square);
      square = hn::Mul(square, square);
    }
    return result;
  }
  HWY_ALIGN float values[HWY_MAX_BYTES / 4];
  hn::Store(base, d, values);
  const F64 wide;
  const Half half;
  for (size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(wide)) {
    const auto x = hn::PromoteTo(wide, hn::LoadU(half, values + i));
    const auto y = HWY_NAMESPACE::Pow(wide, x, hn::Set(wide, static_cast<double>(exponent)));
    hn::StoreU(hn::DemoteTo(half, y), half, values + i);
  }
  return hn::Load(d, values);
}

void Locate(const HitGeometry& g, SurfaceHits* hits) {
  const F64 d;
  const Half half;
  const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  const auto linear = [&](double at, double along_x, double along_y, hn::Vec<F64> x,
                          hn::Vec<F64> y) HWY_ATTR {
    return hn::Add(hn::Add(set(at), hn::Mul(x, set(along_x))), hn::Mul(y, set(along_y)));
  };
  const Rays& rays = g.rays;
  const Vec3& start = g.orthographic ? rays.origin : rays.direction;
  // height over the linear form: start and slopes
  const double h0 = glm::dot(g.height_row, start);
  const double hx = glm::dot(g.height_row, rays.along_x);
  const double hy = glm::dot(g.height_row, rays.along_y);
  const double at_eye = (g.orthographic ? 0 : glm::dot(g.height_row, g.eye)) + g.height_offset;
  const double per_depth = g.orthographic ? -glm::dot(g.height_row, g.forward) : 0;
  for (size_t i = 0; i < hits->size; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, &hits->x[i]), y = hn::LoadU(d, &hits->y[i]);
    const auto depth = hn::LoadU(d, &hits->depth[i]);
    // orthographic: distance is -depth and the form gives points; perspective: it gives directions
    const auto scale = g.orthographic ? set(1) : hn::Div(set(1), depth);
    hn::Vec<F64> form[3];
    for (int k = 0; k < 3; ++k) {
      form[k] = linear(start[k], rays.along_x[k], rays.along_y[k], x, y);
      const auto to_eye = g.orthographic ? set(-g.forward[k]) : hn::Neg(form[k]);
      hn::StoreU(hn::DemoteTo(half, to_eye), half, &hits->to_eye[k][i]);
    }
    auto height = hn::Add(hn::Mul(linear(h0, hx, hy, x, y), scale), set(at_eye));
    if (g.orthographic) height = hn::Add(height, hn::Mul(depth, set(per_depth)));
    hn::StoreU(hn::DemoteTo(half, height), half, &hits->height[i]);
    if (!g.wants_position) continue;
    for (int k = 0; k < 3; ++k) {
      const auto p = g.orthographic ? hn::Sub(form[k], hn::Mul(depth, set(g.forward[k])))
                                    : hn::Add(set(g.eye[k]), hn::Mul(form[k], scale));
      hn::StoreU(p, d, &hits->position[k][i]);
    }
  }
}

void Ramp(const RampStop* stops, size_t count, SurfaceHits* hits) {
  const F32 d;
  for (size_t i = 0; i < hits->size; i += hn::Lanes(d)) {
    const V height = hn::LoadU(d, &hits->height[i]);
    V color[3];
    for (int k = 0; k < 3; ++k) color[k] = hn::Set(d, stops[0].color[k]);
    for (size_t s = 1; s < count; ++s) {
      const auto from = static_cast<float>(stops[s - 1].height - stops[0].height);
      const auto width = static_cast<float>(stops[s].height - stops[s - 1].height);
      const float inverse = width > 1e-30f ? 1 / width : 1e30f;
      V t = hn::Mul(hn::Sub(height, hn::Set(d, from)), hn::Set(d, inverse));
      t = Positive(d, t);
      t = hn::IfThenElse(hn::Lt(t, hn::Set(d, 1.f)), t, hn::Set(d, 1.f));
      for (int k = 0; k < 3; ++k) {
        color[k] = hn::Add(color[k], hn::Mul(hn::Sub(hn::Set(d, stops[s].color[k]), color[k]), t));
      }
    }
    for (int k = 0; k < 3; ++k) hn::StoreU(color[k], d, &hits->color[k][i]);
  }
}

// Unit vector from the position to a local light, and how much of it arrives.
struct Arrival {
  V3 to_light;
  V share;
};

HWY_INLINE Arrival Reach(F32 d, const ShadeLight& light, const SurfaceHits& hits, size_t first) {
  HWY_ALIGN float way[3][HWY_MAX_BYTES / 4];
  const F64 wide;
  const Half half;
  for (int k = 0; k < 3; ++k) {
    for (size_t i = 0; i < hn::Lanes(d); i += hn::Lanes(wide)) {
      const auto p = hn::LoadU(wide, &hits.position[k][first + i]);
      hn::StoreU(hn::DemoteTo(half, hn::Sub(hn::Set(wide, light.place[k]), p)), half, way[k] + i);
    }
  }
  const V3 l = {hn::Load(d, way[0]), hn::Load(d, way[1]), hn::Load(d, way[2])};
  const V distance = hn::Sqrt(Dot(l, l));
  const V left =
      Positive(d, hn::Sub(hn::Set(d, 1.f), hn::Mul(distance, hn::Set(d, light.inverse_range))));
  return {Normalize(d, l), hn::Mul(left, left)};
}

void Light(const Surface& surface, const ShadeLight* lights, size_t count, SurfaceHits* hits) {
  const F32 d;
  const auto& m = surface.normal_matrix;
  const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
  const bool shiny = surface.specular > 0 && surface.shininess > 0;
  for (size_t i = 0; i < hits->size; i += hn::Lanes(d)) {
    const V3 raw = {hn::LoadU(d, &hits->normal[0][i]), hn::LoadU(d, &hits->normal[1][i]),
                    hn::LoadU(d, &hits->normal[2][i])};
    const auto row = [&](int r) HWY_ATTR {
      return Dot({set(m[r]), set(m[r + 1]), set(m[r + 2])}, raw);
    };
    const V3 to_eye =
        Normalize(d, {hn::LoadU(d, &hits->to_eye[0][i]), hn::LoadU(d, &hits->to_eye[1][i]),
                      hn::LoadU(d, &hits->to_eye[2][i])});
    V3 normal = Normalize(d, {row(0), row(3), row(6)});
    const auto away = hn::Lt(Dot(normal, to_eye), hn::Zero(d));
    normal = {hn::IfThenElse(away, hn::Neg(normal.x), normal.x),
              hn::IfThenElse(away, hn::Neg(normal.y), normal.y),
              hn::IfThenElse(away, hn::Neg(normal.z), normal.z)};
    V base[3], sum[3];
    for (int k = 0; k < 3; ++k) {
      base[k] = hn::LoadU(d, &hits->color[k][i]);
      sum[k] = hn::Mul(base[k], set(surface.ambient[k]));
    }
    for (size_t j = 0; j < count; ++j) {
      const ShadeLight& light = lights[j];
      Arrival arrival = {
          {set(static_cast<float>(light.place.x)), set(static_cast<float>(light.place.y)),
           set(static_cast<float>(light.place.z))},
          set(1)};
      if (light.local) arrival = Reach(d, light, *hits, i);
      if (light.shadow >= 0) {
        const std::vector<float>& share = hits->arrives[static_cast<size_t>(light.shadow)];
        arrival.share = hn::Mul(arrival.share, hn::LoadU(d, &share[i]));
      }
      const V facing = Positive(d, Dot(normal, arrival.to_light));
      const V diffuse = hn::Mul(hn::Mul(set(surface.diffuse), facing), arrival.share);
      for (int k = 0; k < 3; ++k) {
        sum[k] = hn::Add(sum[k], hn::Mul(base[k], hn::Mul(diffuse, set(light.color[k]))));
      }
      if (!shiny) continue;
      const V3 h = Normalize(
          d, {hn::Add(arrival.to_light.x, to_eye.x), hn::Add(arrival.to_light.y, to_eye.y),
              hn::Add(arrival.to_light.z, to_eye.z)});
      V along = Positive(d, Dot(normal, h));
      along = hn::IfThenElse(hn::Lt(along, set(1)), along, set(1));
      const V shine = hn::Mul(hn::Mul(Highlight(d, along, surface.shininess), arrival.share),
                              set(surface.specular));
      const V seen = hn::IfThenElseZero(hn::Gt(facing, hn::Zero(d)), shine);
      for (int k = 0; k < 3; ++k) {
        const V rest = Positive(d, hn::Sub(set(light.color[k]), base[k]));
        sum[k] = hn::Add(sum[k], hn::Mul(rest, seen));
      }
    }
    for (int k = 0; k < 3; ++k) hn::StoreU(sum[k], d, &hits->color[k][i]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Locate);
HWY_EXPORT(Ramp);
HWY_EXPORT(Light);
}  // namespace

void SurfaceHits::Resize(size_t count) {
  constexpr size_t kLanes = 64;
  const size_t room = (count + kLanes - 1) / kLanes * kLanes;
  size = count;
  const auto grow = [room](auto& v) {
    if (v.size() < room) v.resize(room);
  };
  grow(place);
  grow(record);
  grow(x);
  grow(y);
  if (depth.size() < room) depth.resize(room, 1);
  for (int k = 0; k < 3; ++k) {
    grow(normal[k]);
    grow(to_eye[k]);
    grow(position[k]);
    grow(color[k]);
  }
  grow(height);
  for (auto& share : arrives) grow(share);
}

void LocateHits(const HitGeometry& geometry, SurfaceHits* hits) {
  HWY_DYNAMIC_DISPATCH(Locate)(geometry, hits);
}

void ColorByHeight(std::span<const RampStop> ramp, SurfaceHits* hits) {
  HWY_DYNAMIC_DISPATCH(Ramp)(ramp.data(), ramp.size(), hits);
}

void Illuminate(const Surface& surface, std::span<const ShadeLight> lights, SurfaceHits* hits) {
  if (!surface.lit) return;
  HWY_DYNAMIC_DISPATCH(Light)(surface, lights.data(), lights.size(), hits);
}

}  // namespace fjord
#endif  // HWY_ONCE
