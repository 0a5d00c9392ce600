#include "engine/fractal/settings.h"

namespace fjord {
namespace {

constexpr Knob kKnobs[] = {
    {"H", &FractalSettings::H, 0, 1,
     "smoother: less fine detail against coarse; dimension falls by as much (D = E + 1 - H)"},
    {"sigma", &FractalSettings::sigma, 0, 100,
     "wider spread: the shape strays further from its coarse outline at every level alike"},
    {"amplitude", &FractalSettings::amplitude, 0, 1e6,
     "affine law: all offsets grow in proportion, 1 is fBm of the shape's own units"},
    {"move", &FractalSettings::move, 0, 10,
     "shih law: all offsets grow in proportion to the edges' lengths"},
    {"perturb", &FractalSettings::perturb, 0, 10,
     "PERTURBED: midpoints slide along their edges, so that halving loses its regular beat"},
    {"coast_H", &FractalSettings::coast_H, .06, 1,
     "surface with coast: smoother shore; below .5 it folds into bays and spits"},
};

}  // namespace

std::span<const Knob> AllKnobs() { return kKnobs; }

}  // namespace fjord
