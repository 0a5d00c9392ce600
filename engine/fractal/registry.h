// The list of fractal methods (engine/knobs/registry.h).
#pragma once

#include <span>
#include <string_view>

#include "engine/fractal/method.h"

namespace fjord {

Registry<MethodInfo>& FractalRegistry();

std::span<const MethodInfo> FractalMethods();
// Null where there is no such method.
const MethodInfo* FindFractalMethod(std::string_view name);

inline constexpr uint32_t kMaxLevel = 40;

// Prepares by the method that the settings name, once its table has found no defect in them. Errors
// have no place: "fractal.H: 2; curve takes 0 to 1".
Result<std::unique_ptr<PreparedFractal>> PrepareMethod(CoarseShape shape,
                                                       const MethodSettings& settings);

}  // namespace fjord
