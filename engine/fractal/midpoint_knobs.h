// The knobs that the methods surface, coast and curve share, written down once. Each method's file
// says which of them it has, which directions it knows and what its defaults are.
#pragma once

#include "engine/fractal/method.h"
#include "engine/knobs/knob_table.h"

namespace fjord {

struct MidpointOffer {
  FractalSettings defaults;
  std::span<const KnobWord> directions;
  bool similar_reads_sigma = false;
  bool has_border = false;               // coast, coast_H and by_place
  std::span<const KnobWord> increments;  // none: not offered
};

KnobTable MidpointKnobs(const MidpointOffer& offer);

// A method's own settings and the common ones in one struct, for its kernel.
FractalSettings JoinMidpoint(const FractalCommon& common, const std::any& own);

// Every kDefault replaced by the method's own choice. `method`: surface, coast or curve.
FractalSettings ResolveSettings(const MethodInfo& method, FractalSettings settings);

// Prepares from one struct. `method`: surface, coast or curve.
Result<std::unique_ptr<PreparedFractal>> PrepareMidpoint(const MethodInfo& method,
                                                         CoarseShape shape,
                                                         const FractalSettings& settings);

}  // namespace fjord
