#include "engine/render/micro_records.h"

#include "engine/base/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/micro_records.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"
// after highway.h: compiled per target
#include "engine/fractal/stream_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE VF Larger(VF a, VF b) { return hn::IfThenElse(hn::Lt(a, b), b, a); }

void Records(const StreamVertex* vertices, const MicroWinners& winners, uint32_t object,
             HitRecord* out) {
  const DF d;
  const DS ds;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const VF zero = hn::Zero(d), one = hn::Set(d, 1.0);
  HWY_ALIGN float normal[3][kLanes];
  HWY_ALIGN uint64_t tie[kLanes];
  for (size_t first = 0; first < winners.count; first += kLanes) {
    const Columns a = LoadVertices(vertices, winners.corner[0] + first);
    const Columns b = LoadVertices(vertices, winners.corner[1] + first);
    const Columns c = LoadVertices(vertices, winners.corner[2] + first);
    VF p[3], q[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = b.v[k] - a.v[k];
      q[k] = c.v[k] - a.v[k];
    }
    VF n[3] = {p[1] * q[2] - q[1] * p[2], p[2] * q[0] - q[2] * p[0], p[0] * q[1] - q[0] * p[1]};
    const VF size = Larger(Larger(hn::Abs(n[0]), hn::Abs(n[1])), hn::Abs(n[2]));
    const MF fits = hn::And(hn::Gt(size, hn::Set(d, 1e-15)), hn::Lt(size, hn::Set(d, 1e15)));
    if (!hn::AllTrue(d, fits)) {
      const MF some = hn::Gt(size, zero);
      const VF scale = hn::IfThenElse(fits, one, size);
      for (VF& v : n) v = hn::IfThenElseZero(some, v / scale);
    }
    for (int k = 0; k < 3; ++k) hn::Store(hn::DemoteTo(ds, n[k]), ds, normal[k]);
    const DU du;
    const VU sum = hn::BitCast(du, a.v[6]) + hn::BitCast(du, b.v[6]) + hn::BitCast(du, c.v[6]);
    hn::Store(sum, du, tie);
    const size_t left = winners.count - first;
    for (size_t i = 0; i < kLanes && i < left; ++i) {
      HitRecord& record = out[first + i];
      record.normal = Rgb(normal[0][i], normal[1][i], normal[2][i]);
      record.object = object;
      record.tie = tie[i];
      record.corners = kNoCorners;
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
HWY_EXPORT(Records);
}  // namespace

void MakeRecords(std::span<const StreamVertex> vertices, const MicroWinners& winners,
                 uint32_t object, HitRecord* out) {
  HWY_DYNAMIC_DISPATCH(Records)(vertices.data(), winners, object, out);
}

}  // namespace fjord
#endif  // HWY_ONCE
