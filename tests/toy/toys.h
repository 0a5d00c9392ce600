// Two entries that no program of Fjord has: what they need beside their own files is one line each,
// in toy_test.cpp or toy_main.cpp.
#pragma once

#include "engine/fractal/registry.h"
#include "engine/texture/registry.h"

namespace fjord::testing {

MethodInfo ToyMethod();
StageInfo ToyStage();

}  // namespace fjord::testing
