#include "engine/fractal/midpoint_knobs.h"

#include <utility>

#include "engine/fractal/registry.h"
#include "engine/knobs/knob_row.h"

namespace fjord {
namespace {

using S = FractalSettings;

constexpr double kLowestSimilarH = .06;

constexpr KnobWord kLaws[] = {
    {"AFFINE", 1, "heights and anything displaced along one direction: fBm of that H"},
    {"SIMILAR", 2, "lines that fold: the same shape at every size, dimension 2 - H"},
    {"SHIH", 3, "the law printed in 1989, for its pictures; smooth whatever H says"}};
constexpr KnobWord kVariants[] = {
    {"FIXED", 1, "the direction as it is"},
    {"CURRENT", 2, "turned square to the segment that is halved now"},
    {"PERTURBED", 3, "CURRENT, with a small random part along the segment"}};

bool Affine(const S& s) { return s.law == Law::kAffine; }
bool AffineOrShih(const S& s) { return s.law == Law::kAffine || s.law == Law::kShih; }
bool Shih(const S& s) { return s.law == Law::kShih; }
bool Perturbed(const S& s) { return s.variant == Variant::kPerturbed; }
bool Coast(const S& s) { return s.coast; }

void CheckTogether(const std::any& settings, std::vector<KnobDefect>* defects) {
  const auto& s = std::any_cast<const S&>(settings);
  if (s.law == Law::kSimilar && s.H < kLowestSimilarH) {
    defects->push_back({"H", NumberText(s.H) + "; law SIMILAR takes " +
                                 NumberRange{kLowestSimilarH, 1}.ToString()});
  }
  if (s.increments == Increments::kAdditions &&
      (s.law != Law::kAffine || s.direction != Direction::kEdge || s.variant != Variant::kFixed)) {
    defects->push_back(
        {"increments", "ADDITIONS goes with law AFFINE, direction EDGE and variant FIXED only"});
  }
}

}  // namespace

KnobTable MidpointKnobs(const MidpointOffer& offer) {
  const Knob sigma =
      KnobRow<&S::sigma>(
          "sigma", "wider spread: the shape strays further from its coarse outline at all levels")
          .In(0, 100);
  const Knob rows[] = {
      KnobRow<&S::H>("H", "smoother: less fine detail against coarse; dimension falls by as much")
          .In(0, 1),
      offer.similar_reads_sigma ? sigma
                                : sigma.When("law AFFINE or SHIH", WhenSettings<S, AffineOrShih>),
      KnobRow<&S::amplitude>("amplitude",
                             "all offsets grow in proportion; 1 is fBm of variance 1 "
                             "over distance 1 of the shape's own units")
          .In(0, 1e6)
          .When("law AFFINE", WhenSettings<S, Affine>),
      KnobRow<&S::law>("law", "how far midpoints move").Of(kLaws),
      KnobRow<&S::direction>("direction", "which way midpoints move").Of(offer.directions),
      KnobRow<&S::variant>("variant", "what becomes of the direction at each halving")
          .Of(kVariants),
      KnobRow<&S::uniforms>("uniforms",
                            "rarer large offsets: uniform numbers summed for each "
                            "Gaussian")
          .In(1, kMaxUniforms),
      KnobRow<&S::move>("move", "all offsets grow in proportion to the edges' lengths")
          .In(0, 10)
          .When("law SHIH", WhenSettings<S, Shih>),
      KnobRow<&S::perturb>(
          "perturb", "midpoints slide along their edges, so that halving loses its regular beat")
          .In(0, 10)
          .When("variant PERTURBED", WhenSettings<S, Perturbed>),
      KnobRow<&S::stretch>("stretch", "offsets follow the size of the shape against its rest pose")
          .When("law AFFINE", WhenSettings<S, Affine>),
      KnobRow<&S::increments>("increments", "what each halving adds").Of(offer.increments),
      KnobRow<&S::coast>("coast", "the border moves level, as a coast"),
      KnobRow<&S::coast_H>("coast_H", "smoother shore; below .5 it folds into bays and spits")
          .In(.06, 1)
          .When("coast true", WhenSettings<S, Coast>),
      KnobRow<&S::by_place>("by_place",
                            "detail follows places in the object's space instead of vertex "
                            "numbers: neighbouring tiles meet, with direction UP"),
  };
  static_assert(FieldCount<S>() == 1 + std::size(rows),
                "every field but the common ones has a row");
  constexpr size_t kForAll = 10;  // then increments and the border's
  std::vector<Knob> offered(rows, rows + kForAll);
  if (!offer.increments.empty()) offered.push_back(rows[kForAll]);
  if (offer.has_border) offered.insert(offered.end(), rows + kForAll + 1, std::end(rows));
  return KnobTable(std::move(offered), offer.defaults, CheckTogether);
}

FractalSettings JoinMidpoint(const FractalCommon& common, const std::any& own) {
  FractalSettings settings = std::any_cast<const FractalSettings&>(own);
  static_cast<FractalCommon&>(settings) = common;
  return settings;
}

FractalSettings ResolveSettings(const MethodInfo& method, FractalSettings settings) {
  const auto& defaults = std::any_cast<const FractalSettings&>(method.knobs.defaults());
  settings.method = method.name;
  if (settings.law == Law::kDefault) settings.law = defaults.law;
  if (settings.direction == Direction::kDefault) settings.direction = defaults.direction;
  if (settings.variant == Variant::kDefault) settings.variant = defaults.variant;
  if (settings.split == Split::kDefault) settings.split = Split::kShot;
  return settings;
}

Result<std::unique_ptr<PreparedFractal>> PrepareMidpoint(const MethodInfo& method,
                                                         CoarseShape shape,
                                                         const FractalSettings& settings) {
  const FractalSettings resolved = ResolveSettings(method, settings);
  return PrepareMethod(std::move(shape), {resolved, resolved});
}

}  // namespace fjord
