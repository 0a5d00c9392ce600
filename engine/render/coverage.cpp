#include "engine/render/coverage.h"

#include <algorithm>
#include <cstring>

#include "engine/base/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/coverage.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using I32 = hn::ScalableTag<int32_t>;

// ToFixed of view.cpp: saturates, then floor(v + 1/2). Lanes with NaN are replaced by the caller.
template <class D, class V>
HWY_INLINE hn::Vec<hn::Rebind<int32_t, D>> Fixed(D d, V v) {
  const auto guard = hn::Set(d, static_cast<double>(kFixedGuard));
  const auto inside = hn::Min(hn::Max(v, hn::Neg(guard)), guard);
  const hn::Rebind<int32_t, D> di;
  return hn::DemoteTo(di, hn::Floor(hn::Add(inside, hn::Set(d, .5))));
}

// ((r0 x + r1 y) + r2 z) + r3, as Row in view.h.
template <class D, class V>
HWY_INLINE V RowTimes(D d, const std::array<double, 4>& r, V x, V y, V z) {
  const V sum = hn::Add(hn::Mul(hn::Set(d, r[0]), x), hn::Mul(hn::Set(d, r[1]), y));
  return hn::Add(hn::Add(sum, hn::Mul(hn::Set(d, r[2]), z)), hn::Set(d, r[3]));
}

void Project(const Projection& to, const StreamVertex* HWY_RESTRICT vertices, size_t count,
             int32_t* HWY_RESTRICT xy, double* HWY_RESTRICT depth) {
  const F64 d;
  const hn::Rebind<int32_t, F64> di;
  const size_t lanes = hn::Lanes(d);
  HWY_ALIGN double px[HWY_MAX_BYTES / 8], py[HWY_MAX_BYTES / 8], pz[HWY_MAX_BYTES / 8];
  HWY_ALIGN int32_t fx[HWY_MAX_BYTES / 4], fy[HWY_MAX_BYTES / 4];
  const auto near = hn::Set(d, to.near);
  const auto guard = hn::Set(d, static_cast<double>(kFixedGuard));
  const auto one = hn::Set(d, 1.0);
  for (size_t first = 0; first < count; first += lanes) {
    const size_t n = std::min(lanes, count - first);
    for (size_t i = 0; i < lanes; ++i) {
      const Vec3& p = vertices[first + std::min(i, n - 1)].position;
      px[i] = p.x;
      py[i] = p.y;
      pz[i] = p.z;
    }
    const auto x = hn::Load(d, px), y = hn::Load(d, py), z = hn::Load(d, pz);
    const auto cz = RowTimes(d, to.z, x, y, z);
    auto sx = RowTimes(d, to.x, x, y, z);
    auto sy = RowTimes(d, to.y, x, y, z);
    auto nearness = hn::Neg(cz);
    if (!to.orthographic) {
      nearness = hn::Div(one, cz);
      sx = hn::Mul(sx, nearness);
      sy = hn::Mul(sy, nearness);
    }
    const auto inside =
        hn::And(hn::And(hn::Ge(cz, near), hn::Lt(hn::Abs(sx), guard)), hn::Lt(hn::Abs(sy), guard));
    const auto zero = hn::Zero(d);
    hn::Store(Fixed(d, hn::IfThenElse(inside, sx, zero)), di, fx);
    hn::Store(Fixed(d, hn::IfThenElse(inside, sy, zero)), di, fy);
    hn::StoreU(nearness, d, depth + first);  // padded: see ProjectVertices
    for (size_t i = 0; i < lanes; ++i) {
      xy[2 * (first + i)] = fx[i];
      xy[2 * (first + i) + 1] = fy[i];
    }
    if (!hn::AllTrue(d, inside)) {
      uint8_t bits[8] = {};
      hn::StoreMaskBits(d, inside, bits);
      for (size_t i = 0; i < lanes; ++i) {
        if (((bits[i / 8] >> (i % 8)) & 1) == 0) xy[2 * (first + i)] = kOutOfGuard;
      }
    }
  }
}

// One edge a -> b of a lane's triangle: value at (x, y) = A x + B y + value, >= 0 inside; the
// top-left rule is in the value.
template <class V>
struct LaneEdge {
  V a, b, value;
};

template <class V>
HWY_INLINE LaneEdge<V> MakeEdge(I32 d, V ax, V ay, V bx, V by, V ox, V oy) {
  const V a = hn::Sub(ay, by);
  const V b = hn::Sub(bx, ax);
  const V zero = hn::Zero(d);
  const auto left = hn::Gt(a, zero);
  const auto top = hn::And(hn::Eq(a, zero), hn::Gt(b, zero));
  const V bias = hn::IfThenZeroElse(hn::Or(left, top), hn::Set(d, -1));
  const V value = hn::Add(hn::Mul(a, hn::Sub(ox, ax)), hn::Add(hn::Mul(b, hn::Sub(oy, ay)), bias));
  return {a, b, value};
}

void Cover(const Triangle* HWY_RESTRICT triangles, size_t count, const int32_t* HWY_RESTRICT xy,
           const TileRect& tile, const SamplePlace* places, int samples, CoverageList* out) {
  const I32 d;
  const hn::RebindToUnsigned<I32> du;
  const size_t lanes = hn::Lanes(d);
  using V = hn::Vec<I32>;
  HWY_ALIGN int64_t corner[3][HWY_MAX_BYTES / 4];
  const V first_x = hn::Set(d, tile.x), last_x = hn::Set(d, tile.right() - 1);
  const V first_y = hn::Set(d, tile.y), last_y = hn::Set(d, tile.bottom() - 1);
  const V two = hn::Set(d, 2);
  const V before_last_x = hn::Set(d, tile.right() - 2),
          before_last_y = hn::Set(d, tile.bottom() - 2);
  const int group = samples == 1 ? 1 : 4;
  // Bits of the mask that belong to the left and right column, upper and lower row.
  const int32_t pixel_bits = group == 1 ? 1 : 15;
  const int32_t left_bits = pixel_bits | (pixel_bits << (2 * group));
  const int32_t upper_bits = pixel_bits | (pixel_bits << group);
  size_t hits = 0, larges = 0;

  for (size_t first = 0; first < count; first += lanes) {
    const size_t n = std::min(lanes, count - first);
    for (size_t i = 0; i < n; ++i) {
      const Triangle& t = triangles[first + i];
      std::memcpy(&corner[0][i], xy + 2 * size_t{t[0]}, 8);
      std::memcpy(&corner[1][i], xy + 2 * size_t{t[1]}, 8);
      std::memcpy(&corner[2][i], xy + 2 * size_t{t[2]}, 8);
    }
    for (size_t i = n; i < lanes; ++i) corner[0][i] = corner[1][i] = corner[2][i] = 0;
    V x0, y0, x1, y1, x2, y2;
    hn::LoadInterleaved2(d, reinterpret_cast<const int32_t*>(corner[0]), x0, y0);
    hn::LoadInterleaved2(d, reinterpret_cast<const int32_t*>(corner[1]), x1, y1);
    hn::LoadInterleaved2(d, reinterpret_cast<const int32_t*>(corner[2]), x2, y2);

    const V px = hn::ShiftRight<8>(hn::Min(hn::Min(x0, x1), x2));
    const V py = hn::ShiftRight<8>(hn::Min(hn::Min(y0, y1), y2));
    const V qx = hn::ShiftRight<8>(hn::Max(hn::Max(x0, x1), x2));
    const V qy = hn::ShiftRight<8>(hn::Max(hn::Max(y0, y1), y2));
    const auto misses = hn::Or(hn::Or(hn::Lt(qx, first_x), hn::Gt(px, last_x)),
                               hn::Or(hn::Lt(qy, first_y), hn::Gt(py, last_y)));
    const auto touches = hn::Not(misses);
    const auto small = hn::And(hn::Lt(hn::Sub(qx, px), two), hn::Lt(hn::Sub(qy, py), two));
    const V area = hn::Sub(hn::Mul(hn::Sub(x1, x0), hn::Sub(y2, y0)),
                           hn::Mul(hn::Sub(x2, x0), hn::Sub(y1, y0)));
    const auto clipped = hn::Eq(qx, hn::Set(d, kOutOfGuard >> 8));
    // Wrapped areas of large triangles are of no account here.
    const auto solid = hn::Ne(area, hn::Zero(d));
    const auto is_large = hn::Or(clipped, hn::AndNot(small, touches));
    const auto active = hn::And(hn::And(touches, small), solid);
    const auto number = hn::Iota(du, static_cast<uint32_t>(first));
    if (!hn::AllFalse(d, is_large)) {
      larges +=
          hn::CompressStore(number, hn::RebindMask(du, is_large), du, out->large.data() + larges);
    }
    if (hn::AllFalse(d, active)) continue;

    const auto turned = hn::Lt(area, hn::Zero(d));
    const V bx = hn::IfThenElse(turned, x2, x1), by = hn::IfThenElse(turned, y2, y1);
    const V cx = hn::IfThenElse(turned, x1, x2), cy = hn::IfThenElse(turned, y1, y2);
    const V ox = hn::ShiftLeft<8>(px), oy = hn::ShiftLeft<8>(py);
    const LaneEdge<V> e0 = MakeEdge(d, x0, y0, bx, by, ox, oy);
    const LaneEdge<V> e1 = MakeEdge(d, bx, by, cx, cy, ox, oy);
    const LaneEdge<V> e2 = MakeEdge(d, cx, cy, x0, y0, ox, oy);
    const V right0 = hn::ShiftLeft<8>(e0.a), right1 = hn::ShiftLeft<8>(e1.a),
            right2 = hn::ShiftLeft<8>(e2.a);
    const V down0 = hn::ShiftLeft<8>(e0.b), down1 = hn::ShiftLeft<8>(e1.b),
            down2 = hn::ShiftLeft<8>(e2.b);
    const V no_left = hn::IfThenElseZero(hn::Lt(px, first_x), hn::Set(d, left_bits));
    const V no_right =
        hn::IfThenElseZero(hn::Gt(px, before_last_x), hn::Set(d, left_bits << group));
    const V no_upper = hn::IfThenElseZero(hn::Lt(py, first_y), hn::Set(d, upper_bits));
    const V no_lower =
        hn::IfThenElseZero(hn::Gt(py, before_last_y), hn::Set(d, upper_bits << (2 * group)));
    const V outside = hn::Or(hn::Or(no_left, no_right), hn::Or(no_upper, no_lower));

    for (int base = 0; base < samples; base += group) {
      V mask = hn::Zero(d);
      for (int i = 0; i < group; ++i) {
        const V dx = hn::Set(d, places[base + i].x), dy = hn::Set(d, places[base + i].y);
        const V s0 = hn::Add(e0.value, hn::Add(hn::Mul(e0.a, dx), hn::Mul(e0.b, dy)));
        const V s1 = hn::Add(e1.value, hn::Add(hn::Mul(e1.a, dx), hn::Mul(e1.b, dy)));
        const V s2 = hn::Add(e2.value, hn::Add(hn::Mul(e2.a, dx), hn::Mul(e2.b, dy)));
        const auto covered = [&](V v0, V v1, V v2, int bit) HWY_ATTR {
          const V negative = hn::ShiftRight<31>(hn::Or(hn::Or(v0, v1), v2));
          mask = hn::Or(mask, hn::AndNot(negative, hn::Set(d, 1 << bit)));
        };
        covered(s0, s1, s2, i);
        covered(hn::Add(s0, right0), hn::Add(s1, right1), hn::Add(s2, right2), group + i);
        const V l0 = hn::Add(s0, down0), l1 = hn::Add(s1, down1), l2 = hn::Add(s2, down2);
        covered(l0, l1, l2, 2 * group + i);
        covered(hn::Add(l0, right0), hn::Add(l1, right1), hn::Add(l2, right2), 3 * group + i);
      }
      mask = hn::AndNot(outside, mask);
      const auto hit = hn::And(active, hn::Ne(mask, hn::Zero(d)));
      if (hn::AllFalse(d, hit)) continue;
      const auto hit_u = hn::RebindMask(du, hit);
      const V marked = hn::Or(mask, hn::Set(d, (base / 4) << 16));
      hn::CompressStore(number, hit_u, du, out->triangle.data() + hits);
      hn::CompressStore(hn::BitCast(du, marked), hit_u, du, out->mask.data() + hits);
      hn::CompressStore(px, hit, d, out->x.data() + hits);
      hits += hn::CompressStore(py, hit, d, out->y.data() + hits);
    }
  }
  out->hits = hits;
  out->larges = larges;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {

// Lanes of the widest level: arrays are padded by so much, and stores may run over.
constexpr size_t kPadding = 64;

template <typename T>
void Grow(std::vector<T>* v, size_t size) {
  if (v->size() < size) v->resize(size);
}

HWY_EXPORT(Project);
HWY_EXPORT(Cover);

}  // namespace

void ProjectVertices(const Projection& to, std::span<const StreamVertex> vertices,
                     ProjectedBatch* out) {
  Grow(&out->xy, 2 * (vertices.size() + kPadding));
  Grow(&out->depth, vertices.size() + kPadding);
  HWY_DYNAMIC_DISPATCH(Project)
  (to, vertices.data(), vertices.size(), out->xy.data(), out->depth.data());
}

void FindCoverage(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                  const TileRect& tile, std::span<const SamplePlace> places, CoverageList* out) {
  const size_t groups = places.size() == 16 ? 4 : 1;
  const size_t most = triangles.size() * groups + kPadding;
  Grow(&out->triangle, most);
  Grow(&out->mask, most);
  Grow(&out->x, most);
  Grow(&out->y, most);
  Grow(&out->large, triangles.size() + kPadding);
  HWY_DYNAMIC_DISPATCH(Cover)
  (triangles.data(), triangles.size(), batch.xy.data(), tile, places.data(),
   static_cast<int>(places.size()), out);
}

}  // namespace fjord
#endif  // HWY_ONCE
