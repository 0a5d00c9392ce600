// The sea: its depths (view_plane.h) and what the sky does to its colour (shade.h).
#include <limits>

#include "engine/base/simd.h"
#include "engine/render/shade.h"
#include "engine/render/view_plane.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/sea.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void Lay(const ViewPlane& plane, const double* HWY_RESTRICT xs, const double* HWY_RESTRICT ys,
         double top, size_t count, double* HWY_RESTRICT depth) {
  const hn::ScalableTag<double> d;
  const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  const auto none = set(-std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, xs + i), y = hn::Add(set(top), hn::LoadU(d, ys + i));
    const auto at = hn::Add(hn::Add(set(plane.depth), hn::Mul(set(plane.along_x), x)),
                            hn::Mul(set(plane.along_y), y));
    const auto seen = hn::And(hn::Gt(at, set(plane.least)), hn::Le(at, set(plane.most)));
    hn::StoreU(hn::IfThenElse(seen, hn::Sub(at, set(plane.rounding)), none), d, depth + i);
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
HWY_EXPORT(Lay);
HWY_EXPORT(Reflect);
}  // namespace

void LayPlane(const ViewPlane& plane, const double* x, const double* y, double top, size_t count,
              double* depth) {
  HWY_DYNAMIC_DISPATCH(Lay)(plane, x, y, top, count, depth);
}

void ReflectSky(const Rgb& horizon, const Rgb& top, SurfaceHits* hits) {
  HWY_DYNAMIC_DISPATCH(Reflect)(horizon, top, hits);
}

}  // namespace fjord
#endif  // HWY_ONCE
