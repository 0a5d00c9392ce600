#include "engine/fractal/registry.h"

#include <string>
#include <utility>

namespace fjord {

// One line an entry; each is the function of that name in engine/fractal/methods. Append only.
#define FJORD_METHODS(ENTRY) \
  ENTRY(SurfaceMethod)       \
  ENTRY(CoastMethod)         \
  ENTRY(CurveMethod)

#define FJORD_DECLARE(name) MethodInfo name();
FJORD_METHODS(FJORD_DECLARE)

Registry<MethodInfo>& FractalRegistry() {
#define FJORD_MAKE(name) name(),
  static Registry<MethodInfo> registry({FJORD_METHODS(FJORD_MAKE)});
  return registry;
}

std::span<const MethodInfo> FractalMethods() { return FractalRegistry().entries(); }

const MethodInfo* FindFractalMethod(std::string_view name) { return FractalRegistry().Find(name); }

Result<std::unique_ptr<PreparedFractal>> PrepareMethod(CoarseShape shape,
                                                       const MethodSettings& settings) {
  const MethodInfo* method = FindFractalMethod(settings.method);
  if (method == nullptr) return Invalid("there is no fractal method \"" + settings.method + "\"");
  const std::vector<KnobDefect> defects = method->knobs.Check(settings.own, method->name);
  if (!defects.empty())
    return Invalid("fractal." + defects.front().knob + ": " + defects.front().message);
  if (settings.max_level > kMaxLevel) {
    return Invalid("fractal.max_level: " + std::to_string(settings.max_level) + "; at most " +
                   std::to_string(kMaxLevel));
  }
  return method->prepare(std::move(shape), settings, settings.own);
}

}  // namespace fjord
