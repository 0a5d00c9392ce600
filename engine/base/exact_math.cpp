#include "engine/base/exact_math.h"

#include "engine/base/exact_math-inl.h"

// One lane of the target every build has: the arithmetic is written down once.
HWY_BEFORE_NAMESPACE();
namespace fjord::exact {
namespace {

namespace lanes = fjord::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

using One = hn::CappedTag<double, 1>;

}  // namespace

double Sin(double radians) {
  const One d;
  return hn::GetLane(lanes::Sin(d, hn::Set(d, radians)));
}

double Cos(double radians) {
  const One d;
  return hn::GetLane(lanes::Cos(d, hn::Set(d, radians)));
}

double Exp2(double x) {
  const One d;
  return hn::GetLane(lanes::Exp2(d, hn::Set(d, x)));
}

double Log2(double x) {
  const One d;
  return hn::GetLane(lanes::Log2(d, hn::Set(d, x)));
}

double Pow(double x, double y) {
  const One d;
  return hn::GetLane(lanes::Pow(d, hn::Set(d, x), hn::Set(d, y)));
}

double Atan2(double y, double x) {
  const One d;
  return hn::GetLane(lanes::Atan2(d, hn::Set(d, y), hn::Set(d, x)));
}

}  // namespace fjord::exact
HWY_AFTER_NAMESPACE();
