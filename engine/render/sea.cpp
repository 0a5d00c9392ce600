// The depths of a plane over a row of samples.
#include <limits>

#include "engine/base/simd.h"
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

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Lay);
}  // namespace

void LayPlane(const ViewPlane& plane, const double* x, const double* y, double top, size_t count,
              double* depth) {
  HWY_DYNAMIC_DISPATCH(Lay)(plane, x, y, top, count, depth);
}

}  // namespace fjord
#endif  // HWY_ONCE
