// The only elementary functions that may touch a vertex or a pixel: made of + - * / and integer
// operations on IEEE doubles, branch-free over their stated range, the same bits on every machine
// (D1). Checked against MPFR (tests/base/exact_math_test.cpp); errors in units in the last place
// are stated there. Templates of the same operations serve SIMD lanes (exact_math-inl.h).
#pragma once

namespace fjord::exact {

double Sin(double radians);  // |x| <= 1e6; larger gives 0 (callers reduce)
double Cos(double radians);
double Exp2(double x);             // x < -1074 gives 0, x > 1023.99 the largest finite double
double Log2(double x);             // x > 0 normal; otherwise -1075
double Pow(double x, double y);    // x >= 0; Exp2(y * Log2(x)); 0^0 = 1, 0^y = 0
double Atan2(double y, double x);  // (0, 0) gives 0

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace fjord::exact
