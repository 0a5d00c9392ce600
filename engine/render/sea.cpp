// The sea's part of shading (shade.h).
#include "engine/base/simd.h"
#include "engine/render/shade.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/sea.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

size_t Find(const ViewPlane& sea, const double* HWY_RESTRICT xs, const double* HWY_RESTRICT ys,
            double top, size_t count, uint32_t mark, double* HWY_RESTRICT depth,
            uint32_t* HWY_RESTRICT owner) {
  const hn::ScalableTag<double> d;
  const size_t lanes = hn::Lanes(d);
  const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  size_t seen = 0;
  for (size_t i = 0; i < count; i += lanes) {
    const size_t n = count - i < lanes ? count - i : lanes;
    const auto x = hn::LoadU(d, xs + i), y = hn::Add(set(top), hn::LoadU(d, ys + i));
    const auto at = hn::Add(hn::Add(set(sea.depth), hn::Mul(set(sea.along_x), x)),
                            hn::Mul(set(sea.along_y), y));
    auto shown = hn::And(hn::And(hn::Gt(at, set(sea.least)), hn::Le(at, set(sea.most))),
                         hn::Gt(hn::Sub(at, set(sea.rounding)), hn::LoadU(d, depth + i)));
    shown = hn::And(shown, hn::FirstN(d, n));
    if (hn::AllFalse(d, shown)) continue;
    hn::BlendedStore(at, shown, d, depth + i);
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, shown, bits);
    for (size_t k = 0; k < n; ++k) {
      if (((bits[k / 8] >> (k % 8)) & 1) == 0) continue;
      owner[i + k] = mark;
      ++seen;
    }
  }
  return seen;
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
HWY_EXPORT(Find);
HWY_EXPORT(Reflect);
}  // namespace

size_t FindSea(const ViewPlane& sea, const double* x, const double* y, double top, size_t count,
               uint32_t mark, double* depth, uint32_t* owner) {
  return HWY_DYNAMIC_DISPATCH(Find)(sea, x, y, top, count, mark, depth, owner);
}

void ReflectSky(const Rgb& horizon, const Rgb& top, SurfaceHits* hits) {
  HWY_DYNAMIC_DISPATCH(Reflect)(horizon, top, hits);
}

}  // namespace fjord
#endif  // HWY_ONCE
