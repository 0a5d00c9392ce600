// The list of fractal methods. Append only: a name keeps its meaning and its place.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/fractal/method.h"

namespace fjord {

std::span<const MethodInfo> FractalMethods();

// Null where there is no such method.
const MethodInfo* FindFractalMethod(std::string_view name);

// Every kDefault replaced by the method's own choice, Split::kDefault by kShot.
FractalSettings ResolveSettings(const MethodInfo& method, FractalSettings settings);

// What a method cannot do with its settings. `field` is the field of scene.proto's Fractal.
struct SettingDefect {
  std::string_view field;
  std::string message;  // "H is 1.2; coast takes 0 to 1"
};

// Ranges, laws, directions, variants, splits and how they go together; kDefault stands for the
// method's own. Fineness is looked at where it is worked out.
std::vector<SettingDefect> FindSettingDefects(const MethodInfo& method,
                                              const FractalSettings& settings);

// The same as errors without a place: "fractal.H: ...".
Errors CheckSettings(const MethodInfo& method, const FractalSettings& settings);

// The scene language's words: "AFFINE", "PERTURBED", ...
std::string_view LawName(Law law);
std::string_view DirectionName(Direction direction);
std::string_view VariantName(Variant variant);
std::string_view SplitName(Split split);

}  // namespace fjord
