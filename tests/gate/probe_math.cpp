// Exact functions, one at a time and in lanes, and keyed draws.
#include "engine/base/exact_math.h"
#include "engine/base/random.h"
#include "tests/gate/probe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/gate/probe_math.cpp"
#include "hwy/foreach_target.h"
// After it: compiled once per target.
#include "engine/base/exact_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

// out[6 * i ..]: Exp2 x, Log2 |x|, Pow(|x|, y), Sin x, Cos x, Atan2(y, x). count a multiple of 8.
void AllFunctions(const double* x, const double* y, size_t count, double* out) {
  const hn::CappedTag<double, 8> d;
  const size_t lanes = hn::Lanes(d);
  double part[8];
  for (size_t i = 0; i < count; i += lanes) {
    const auto vx = hn::LoadU(d, x + i);
    const auto vy = hn::LoadU(d, y + i);
    const auto magnitude = hn::Abs(vx);
    hn::Vec<decltype(d)> values[6] = {Exp2(d, vx), Log2(d, magnitude), Pow(d, magnitude, vy),
                                      Sin(d, vx),  Cos(d, vx),         Atan2(d, vy, vx)};
    for (size_t row = 0; row < 6; ++row) {
      hn::StoreU(values[row], d, part);
      for (size_t lane = 0; lane < lanes; ++lane) out[6 * (i + lane) + row] = part[lane];
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(AllFunctions);

namespace gate {
namespace {

constexpr size_t kCount = 20'000;

struct Inputs {
  std::vector<double> x;
  std::vector<double> y;
};

Inputs MakeInputs() {
  Inputs in;
  const double special[] = {0.,        -0.,      1.,   -1.,    2.,       .5,       5e-324,
                            0x1p-1022, 1e6,      -1e6, 1e300,  -1074.25, 1023.995, -1022.75,
                            1e-300,    0x1p1023, .707, 1.5708, 3e5,      -1e-9};
  for (const double a : special) {
    for (const double b : special) {
      in.x.push_back(a);
      in.y.push_back(b);
    }
  }
  for (uint64_t i = in.x.size(); i < kCount; ++i) {
    const auto unit = [&](uint64_t channel) {
      return static_cast<double>(DrawBits(Mix64(i + 1), channel) >> 11) * 0x1p-53;
    };
    // Any finite bits, the whole range of exponents, and the numbers pictures are made of.
    const uint64_t bits = DrawBits(Mix64(i + 1), 3) & 0xffdfffffffffffffu;
    in.x.push_back(i % 4 == 0 ? std::bit_cast<double>(bits)
                              : (i % 4 == 1 ? 2200 * unit(1) - 1100 : 8 * unit(1) - 4));
    in.y.push_back(i % 8 == 4 ? 2e6 * unit(2) - 1e6 : 6 * unit(2) - 3);
  }
  return in;
}

constexpr const char* kNames[] = {"exp2", "log2", "pow", "sin", "cos", "atan2"};

void ItemsOf(const std::string& group, const std::vector<double>& values, Report& report) {
  for (size_t row = 0; row < 6; ++row) {
    Canon canon;
    for (size_t i = row; i < values.size(); i += 6) canon.Add(values[i]);
    report.Item(group + kNames[row], canon.Finish());
  }
}

}  // namespace

void ProbeMath(Report& report) {
  if (report.Wants("math/")) {
    const Inputs in = MakeInputs();
    std::vector<double> values;
    for (size_t i = 0; i < kCount; ++i) {
      const double x = in.x[i];
      const double magnitude = x < 0 ? -x : x;
      for (const double value :
           {exact::Exp2(x), exact::Log2(magnitude), exact::Pow(magnitude, in.y[i]), exact::Sin(x),
            exact::Cos(x), exact::Atan2(in.y[i], x)}) {
        values.push_back(value);
      }
    }
    ItemsOf("math/", values, report);
  }
  if (report.Wants("random/")) {
    for (const int n : {1, 4, 12}) {
      Canon canon;
      for (uint64_t i = 0; i < kCount; ++i) canon.Add(Gaussian(Mix64(i + 1), n));
      report.Item("random/gaussian" + std::to_string(n), canon.Finish());
    }
    Canon canon;
    Identity a = CoarseIdentity(1, 0);
    for (uint64_t i = 0; i < kCount; ++i) {
      a = MidpointIdentity(a, CoarseIdentity(1, i));
      canon.Add(a.lo);
      canon.Add(a.hi);
      canon.Add(TangentDraw(a.lo));
    }
    report.Item("random/identity", canon.Finish());
  }
}

void ProbeLanes(Report& report) {
  if (!report.Wants("lanes/")) return;
  const Inputs in = MakeInputs();
  std::vector<double> values(6 * kCount);
  HWY_DYNAMIC_DISPATCH(AllFunctions)(in.x.data(), in.y.data(), kCount, values.data());
  ItemsOf("lanes/", values, report);
}

}  // namespace gate
}  // namespace fjord
#endif
