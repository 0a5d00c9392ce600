// Measures a double function's error against MPFR, in units in the last place of the true value.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>

namespace fjord::testing {

// A real number of 200 bits.
class Real {
 public:
  Real() { mpfr_init2(value_, 200); }
  explicit Real(double x) : Real() { mpfr_set_d(value_, x, MPFR_RNDN); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

// |got - truth| in units of the last place of truth rounded to double (denormals count as such).
inline double UlpError(double got, Real& truth) {
  const double rounded = mpfr_get_d(truth.get(), MPFR_RNDN);
  int exponent = 0;
  std::frexp(rounded, &exponent);
  const int unit = std::max(exponent - 53, -1074);
  Real difference(got);
  mpfr_sub(difference.get(), difference.get(), truth.get(), MPFR_RNDN);
  mpfr_mul_2si(difference.get(), difference.get(), -unit, MPFR_RNDN);
  return std::fabs(mpfr_get_d(difference.get(), MPFR_RNDN));
}

}  // namespace fjord::testing
