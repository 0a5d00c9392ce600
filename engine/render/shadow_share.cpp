#include "engine/render/shadow_share.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/shadow_share.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/stream_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

using V = hn::Vec<DS>;  // floats, as many as doubles
using DI32 = hn::Rebind<int32_t, DF>;

constexpr double kBias = 1.25;  // texels; see shadow_map.h
// The most that a surface is taken to rise, texels of depth a texel. What rises more has less than
// 1 / kSteepest of the light.
constexpr double kSteepest = 64;

struct Way {
  VF x, y, z;
};
HWY_INLINE VF Dot(const Way& a, const Way& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Way All(const Vec3& v) {
  const DF d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE Way Load(const std::array<std::vector<float>, 3>& from, size_t i) {
  const auto part = [&](size_t k)
                        HWY_ATTR { return hn::PromoteTo(DF(), hn::LoadU(DS(), &from[k][i])); };
  return {part(0), part(1), part(2)};
}
HWY_INLINE V All(float v) { return hn::Set(DS(), v); }
HWY_INLINE V Positive(V v) { return hn::IfThenElseZero(hn::Gt(v, All(0)), v); }
HWY_INLINE V AtMostOne(V v) { return hn::IfThenElse(hn::Lt(All(1), v), All(1), v); }

// Unit normals in the world, turned to the eye.
HWY_INLINE Way WorldNormal(const std::array<float, 9>& m, const SurfaceHits& hits, size_t i) {
  const DF d;
  const Way raw = Load(hits.normal, i);
  const auto row = [&](size_t r) HWY_ATTR {
    return Dot(All({double{m[r]}, double{m[r + 1]}, double{m[r + 2]}}), raw);
  };
  Way normal{row(0), row(3), row(6)};
  const VF zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const MF away = hn::Lt(Dot(normal, Load(hits.to_eye, i)), zero);
  normal = {hn::IfThenElse(away, hn::Neg(normal.x), normal.x),
            hn::IfThenElse(away, hn::Neg(normal.y), normal.y),
            hn::IfThenElse(away, hn::Neg(normal.z), normal.z)};
  const VF length = hn::Sqrt(Dot(normal, normal));
  const MF some = hn::Gt(length, zero);
  const VF inverse = hn::IfThenElseZero(some, one / hn::IfThenElse(some, length, one));
  return {normal.x * inverse, normal.y * inverse, normal.z * inverse};
}

// Weights of a cubic B-spline at distances t + 1, t, 1 - t, 2 - t.
struct Spline {
  V weight[4];

  HWY_INLINE explicit Spline(V t) {
    const V s = All(1) - t, third = All(1.f / 6), three = All(3), four = All(4), six = All(6);
    weight[0] = s * s * s * third;
    weight[1] = (four - (six - three * t) * t * t) * third;
    weight[2] = (four - (six - three * s) * s * s) * third;
    weight[3] = t * t * t * third;
  }
};

HWY_INLINE V Rise(VF along, VF facing) {
  const DF d;
  const VF most = hn::Set(d, kSteepest), least = hn::Set(d, -kSteepest);
  const VF rise = along / facing;
  const VF above = hn::IfThenElse(hn::Lt(rise, least), least, rise);
  return hn::DemoteTo(DS(), hn::IfThenElse(hn::Lt(most, above), most, above));
}

// What 4x4 texels keep away. `first`: the number of the least of them; `u`, `v`: where between the
// inner ones; `base`: the nearness from which something hides.
HWY_INLINE V Hidden(const ShadowTexels& texels, VN first, V u, V v, V rise_u, V rise_v, V base,
                    float scale) {
  const DN dn;
  const Spline across(u), down(v);
  V hidden = All(0);
  for (uint32_t j = 0; j < 4; ++j) {
    const V along_v = rise_v * (All(static_cast<float>(j) - 1) - v);
    V sum = All(0);
    for (uint32_t i = 0; i < 4; ++i) {
      const V nearest = Gather(texels.nearness, first + hn::Set(dn, j * texels.width + i));
      const V own = rise_u * (All(static_cast<float>(i) - 1) - u) + along_v;
      const V over = (nearest - base) * All(scale) - Positive(own);
      sum = sum + across.weight[i] * AtMostOne(Positive(over));
    }
    hidden = hidden + down.weight[j] * sum;
  }
  return hidden;
}

void Share(const Surface& surface, const ShadowTexels& texels, const View& view,
           const SurfaceHits& hits, float* arrives) {
  const DF d;
  const DN dn;
  const DS ds;
  const DI32 di;
  const VF one = hn::Set(d, 1.0), zero = hn::Zero(d), half = hn::Set(d, .5);
  const Way right = All(view.right), up = All(view.up), to_light = All(-view.forward);
  const VF focal = hn::Set(d, view.focal);
  const VF bias = hn::Set(d, kBias * (1 / view.focal));
  const VF most_u = hn::Set(d, texels.width - 3.0), most_v = hn::Set(d, texels.height - 3.0);
  constexpr int kShift = ShadowTexels::kBlockShift;
  for (size_t i = 0; i < hits.size; i += hn::MaxLanes(d)) {
    const Way normal = WorldNormal(surface.normal_matrix, hits, i);
    const VF facing = Dot(normal, to_light);
    const MF faces = hn::Gt(facing, zero);
    const Way point{hn::LoadU(d, &hits.position[0][i]), hn::LoadU(d, &hits.position[1][i]),
                    hn::LoadU(d, &hits.position[2][i])};
    // The middle of texel i lies at i + .5.
    VF u = Dot(point, right) * focal + hn::Set(d, view.center_x) - half;
    VF v = hn::Set(d, view.center_y) - Dot(point, up) * focal - half;
    const MF inside = hn::And(hn::And(hn::Ge(u, one), hn::Ge(v, one)),
                              hn::And(hn::Lt(u, most_u), hn::Lt(v, most_v)));
    u = hn::IfThenElse(inside, u, one);
    v = hn::IfThenElse(inside, v, one);
    // Of positive numbers the floor.
    const auto whole_u = hn::DemoteTo(di, u), whole_v = hn::DemoteTo(di, v);
    const VN x = hn::BitCast(dn, whole_u), y = hn::BitCast(dn, whole_v);
    const V base = hn::DemoteTo(ds, Dot(point, to_light) + bias);
    const VN block =
        hn::ShiftRight<kShift>(y) * hn::Set(dn, texels.blocks_x) + hn::ShiftRight<kShift>(x);
    const VF round = hn::PromoteTo(d, Gather(texels.most, block));
    const MF hides = hn::And(inside, hn::Gt(round, hn::PromoteTo(d, base)));
    VF share = one;
    if (!hn::AllFalse(d, hn::And(faces, hides))) {
      // How much nearer to the light its plane comes from one texel to the next.
      const VF least = hn::Set(d, 1e-3);
      const VF slant = hn::IfThenElse(hn::Lt(facing, least), least, facing);
      const V rise_u = Rise(hn::Neg(Dot(normal, right)), slant);
      const V rise_v = Rise(Dot(normal, up), slant);
      const V du = hn::DemoteTo(ds, u - hn::PromoteTo(d, whole_u));
      const V dv = hn::DemoteTo(ds, v - hn::PromoteTo(d, whole_v));
      const VN width = hn::Set(dn, texels.width), step = hn::Set(dn, 1);
      const V hidden = Hidden(texels, (y - step) * width + (x - step), du, dv, rise_u, rise_v, base,
                              static_cast<float>(view.focal));
      share = hn::IfThenElse(hides, hn::PromoteTo(d, All(1) - AtMostOne(hidden)), one);
    }
    hn::StoreU(hn::DemoteTo(ds, hn::IfThenElseZero(faces, share)), ds, arrives + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Share);
}  // namespace

void ShareOfLight(const Surface& surface, const ShadowMap& map, const SurfaceHits& hits,
                  float* arrives) {
  HWY_DYNAMIC_DISPATCH(Share)(surface, map.texels(), map.view(), hits, arrives);
}

}  // namespace fjord
#endif
