#include "engine/fractal/amount.h"

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/exact_math.h"
#include "engine/base/random.h"

namespace fjord {
namespace {

// Density of the sum of n uniforms on 0..1 (Irwin-Hall) at x: a cardinal B-spline, by its
// recurrence, all terms of one sign.
double SumDensity(int n, double x) {
  double spline[kMaxUniforms];
  for (int i = 0; i < n; ++i) {
    spline[i] = (x >= i && x < i + 1) ? 1 : 0;  // degree 0, shifted by i
  }
  for (int k = 2; k <= n; ++k) {
    for (int i = 0; i + k <= n; ++i) {
      spline[i] = ((x - i) * spline[i] + (i + k - x) * spline[i + 1]) / (k - 1);
    }
  }
  return spline[0];
}

// |g| at the middle of each cell of the half range, and the probability of the cell on both sides.
struct GaussianCells {
  std::vector<double> size;
  std::vector<double> weight;

  explicit GaussianCells(int uniforms) {
    constexpr int kCells = 512;
    const double bound = GaussianBound(uniforms);
    const double width = .5 * uniforms / kCells;
    double sum = 0;
    for (int i = 0; i < kCells; ++i) {
      const double share = (i + .5) / kCells;
      size.push_back(bound * share);
      weight.push_back(SumDensity(uniforms, .5 * uniforms + share * .5 * uniforms) * width);
      sum += weight.back();
    }
    for (double& w : weight) {
      w /= sum;
    }
  }

  // 2 E[(1/4 + min(r |g|, clamp)^2)^(D/2)]: what the two halves' lengths sum to, to the power D.
  double Moran(double r, double D) const {
    double sum = 0;
    for (size_t i = 0; i < size.size(); ++i) {
      double offset = r * size[i];
      offset = offset < kSimilarClamp ? offset : kSimilarClamp;
      sum += weight[i] * exact::Exp2(.5 * D * exact::Log2(.25 + offset * offset));
    }
    return 2 * sum;
  }
};

}  // namespace

double AffineConstant(double H) {
  return H < 1 ? exact::Exp2(-H) * std::sqrt(1 - exact::Exp2(2 * H - 2)) : 0;
}

double LevelDeviation(double sigma, double H, int n) {
  return H < 1 ? sigma * exact::Exp2(-n * H) * std::sqrt(1 - exact::Exp2(2 * H - 2)) : 0;
}

double ShihDeviation(double sigma, double H, int i) {
  return H < 1 ? sigma * exact::Exp2(-i * H) * std::sqrt(.5) * std::sqrt(1 - exact::Exp2(2 * H - 2))
               : 0;
}

Result<double> SimilarFactor(double H, int uniforms) {
  FJORD_CHECK(uniforms >= 1 && uniforms <= kMaxUniforms, uniforms);
  if (!(H >= 0 && H <= 1)) {
    return Invalid("H is outside 0..1");
  }
  const double D = 2 - H;
  const GaussianCells cells(uniforms);
  if (H >= 1) {
    return 0.0;
  }
  double low = 0;
  double high = 1;
  while (high < 0x1p20 && cells.Moran(high, D) < 1) {
    high *= 2;
  }
  if (cells.Moran(high, D) < 1) {
    return Invalid("the similar law cannot reach dimension " + std::to_string(D) +
                   "; choose H of .06 or more");
  }
  for (int step = 0; step < 48; ++step) {
    const double r = .5 * (low + high);
    (cells.Moran(r, D) < 1 ? low : high) = r;
  }
  return .5 * (low + high);
}

double HeldBackH(double H) {
  const double d = 1 - H;
  const double fitted = H - 1.7 * d * d;
  const double rest = .06 + .4963 * (H - .06);  // so that the knob keeps turning
  return fitted > rest ? fitted : rest;
}

}  // namespace fjord
