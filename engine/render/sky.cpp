#include "engine/render/sky.h"

#include "engine/base/simd.h"
#include "engine/render/surface_hits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/sky.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void Dome(const Sky& sky, SurfaceHits* hits) {
  const hn::ScalableTag<float> d;
  const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
  for (size_t i = 0; i < hits->size; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, &hits->to_eye[0][i]), y = hn::LoadU(d, &hits->to_eye[1][i]),
               z = hn::LoadU(d, &hits->to_eye[2][i]);
    const auto length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
    const auto rise = hn::Div(hn::Neg(z), length);
    const auto c = hn::IfThenElseZero(hn::Gt(rise, hn::Zero(d)), rise);
    for (int k = 0; k < 3; ++k) {
      const auto change = set(sky.top[k] - sky.bottom[k]);
      hn::StoreU(hn::Add(set(sky.bottom[k]), hn::Mul(change, c)), d, &hits->color[k][i]);
    }
  }
}

void Reflect(const Rgb& horizon, const Rgb& top, SurfaceHits* hits) {
  const hn::ScalableTag<float> d;
  const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
  for (size_t i = 0; i < hits->size; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, &hits->to_eye[0][i]), y = hn::LoadU(d, &hits->to_eye[1][i]),
               z = hn::LoadU(d, &hits->to_eye[2][i]);
    const auto length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
    const auto c = hn::Div(hn::Abs(z), length);
    const auto m = hn::Sub(set(1), c);
    const auto m2 = hn::Mul(m, m);
    const auto share = hn::Add(set(.02f), hn::Mul(set(.98f), hn::Mul(hn::Mul(m2, m2), m)));
    for (int k = 0; k < 3; ++k) {
      const auto sky = hn::Add(set(horizon[k]), hn::Mul(set(top[k] - horizon[k]), c));
      const auto color = hn::LoadU(d, &hits->color[k][i]);
      hn::StoreU(hn::Add(color, hn::Mul(hn::Sub(sky, color), share)), d, &hits->color[k][i]);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Dome);
HWY_EXPORT(Reflect);
}  // namespace

void ColorByDirection(const Sky& sky, SurfaceHits* hits) { HWY_DYNAMIC_DISPATCH(Dome)(sky, hits); }

void ReflectSky(const Rgb& horizon, const Rgb& top, SurfaceHits* hits) {
  HWY_DYNAMIC_DISPATCH(Reflect)(horizon, top, hits);
}

}  // namespace fjord
#endif  // HWY_ONCE
