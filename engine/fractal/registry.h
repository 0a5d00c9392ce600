// The list of fractal methods. Append only: a name keeps its meaning and its place.
#pragma once

#include <span>
#include <string_view>

#include "engine/fractal/method.h"

namespace fjord {

std::span<const MethodInfo> FractalMethods();

// Null where there is no such method.
const MethodInfo* FindFractalMethod(std::string_view name);

}  // namespace fjord
