// A toy fractal method, the whole of it: it lifts the coarse shape and splits nothing.
#include <utility>

#include "engine/fractal/plain.h"
#include "engine/knobs/knob_row.h"
#include "tests/toy/toys.h"

namespace fjord::testing {
namespace {

struct ToySettings {
  double lift = .5;
  uint32_t rounds = 2;
};

const Knob kRows[] = {
    KnobRow<&ToySettings::lift>("toy_lift", "the shape stands higher").In(0, 3),
    KnobRow<&ToySettings::rounds>("toy_rounds", "lifted more often").In(1, 9),
};

}  // namespace

MethodInfo ToyMethod() {
  return {{.name = "toy",
           .version = 7,
           .summary = "lifts the shape",
           .knobs = KnobTableOf<ToySettings>(kRows)},
          Takes::kTriangles,
          [](CoarseShape shape, const FractalCommon& common, const std::any& own) {
            const auto& settings = std::any_cast<const ToySettings&>(own);
            for (Vec3& point : shape.now) point.z += settings.lift * settings.rounds;
            return PreparePlain(std::move(shape), common.seed);
          }};
}

}  // namespace fjord::testing
