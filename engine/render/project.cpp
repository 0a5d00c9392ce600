// Vertices to the fixed grid and depth, many in lock-step: view.cpp, operation by operation.
#include <algorithm>

#include "engine/base/simd.h"
#include "engine/render/coverage.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/project.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"
// after highway.h: compiled per target
#include "engine/fractal/stream_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

void Project(const Projection& to, const StreamVertex* HWY_RESTRICT vertices, size_t count,
             int32_t* HWY_RESTRICT xy, double* HWY_RESTRICT depth) {
  const DF d;
  const hn::Rebind<int32_t, DF> di;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const VF near = hn::Set(d, to.near), one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const VF guard = hn::Set(d, static_cast<double>(kFixedGuard));
  HWY_ALIGN uint32_t numbers[kLanes];
  const auto row = [&](const std::array<double, 4>& r, const Columns& c) HWY_ATTR {
    const VF sum = hn::Set(d, r[0]) * c.v[0] + hn::Set(d, r[1]) * c.v[1];
    return (sum + hn::Set(d, r[2]) * c.v[2]) + hn::Set(d, r[3]);
  };
  // view.cpp's ToFixed: floor(v + 1/2); inside the guard, or kOutOfGuard, which stays itself.
  const auto fixed = [&](VF v) HWY_ATTR { return hn::DemoteTo(di, hn::Floor(v + hn::Set(d, .5))); };
  for (size_t first = 0; first < count; first += kLanes) {
    for (size_t i = 0; i < kLanes; ++i) {
      numbers[i] = static_cast<uint32_t>(std::min(first + i, count - 1));
    }
    const Columns c = LoadVertices(vertices, numbers);
    const VF cz = row(to.z, c);
    VF x = row(to.x, c), y = row(to.y, c);
    VF nearness = hn::Neg(cz);
    if (!to.orthographic) {
      nearness = one / cz;
      x = x * nearness;
      y = y * nearness;
    }
    const MF inside =
        hn::And(hn::Ge(cz, near), hn::And(hn::Lt(hn::Abs(x), guard), hn::Lt(hn::Abs(y), guard)));
    const auto px = fixed(hn::IfThenElse(inside, x, hn::Set(d, double{kOutOfGuard})));
    const auto py = fixed(hn::IfThenElse(inside, y, zero));
    hn::StoreU(nearness, d, depth + first);
    hn::StoreInterleaved2(px, py, di, xy + 2 * first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Project);
}  // namespace

void ProjectVertices(const Projection& to, std::span<const StreamVertex> vertices,
                     ProjectedBatch* out) {
  constexpr size_t kPadding = 64;  // lanes of the widest level may run over
  if (out->depth.size() < vertices.size() + kPadding) {
    out->xy.resize(2 * (vertices.size() + kPadding));
    out->depth.resize(vertices.size() + kPadding);
  }
  if (vertices.empty()) return;
  HWY_DYNAMIC_DISPATCH(Project)
  (to, vertices.data(), vertices.size(), out->xy.data(), out->depth.data());
}

}  // namespace fjord
#endif  // HWY_ONCE
