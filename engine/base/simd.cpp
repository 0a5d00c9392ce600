#include "engine/base/simd.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace fjord {
namespace {

std::string LevelName(int64_t target) {
  std::string name = hwy::TargetName(target);
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

// Better targets have smaller numbers.
int64_t CompiledAndPresent() {
  hwy::SetSupportedTargetsForTest(0);
  return (hwy::SupportedTargets() | HWY_STATIC_TARGET | HWY_SCALAR) & HWY_TARGETS;
}

int64_t current = 0;  // 0: best

void Apply(int64_t target) {
  current = target;
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(target == 0 ? hwy::SupportedTargets() : target);
}

std::vector<int64_t> Targets() {
  std::vector<int64_t> targets;
  const int64_t keep = current;
  for (int64_t left = CompiledAndPresent(); left != 0; left &= left - 1) {
    targets.push_back(left & -left);
  }
  Apply(keep);
  std::reverse(targets.begin(), targets.end());
  return targets;
}

}  // namespace

std::vector<std::string> SimdLevels() {
  std::vector<std::string> names;
  for (const int64_t target : Targets()) names.push_back(LevelName(target));
  return names;
}

bool SetSimdLevel(std::string_view level) {
  if (level == "best") {
    Apply(0);
    return true;
  }
  for (const int64_t target : Targets()) {
    if (LevelName(target) == level) {
      Apply(target);
      return true;
    }
  }
  return false;
}

std::string SimdLevel() { return LevelName(current != 0 ? current : Targets().back()); }

namespace internal {

bool ApplySimdEnvironment() {
  static const bool applied = [] {
    const char* level = std::getenv("FJORD_SIMD");
    if (level == nullptr || *level == '\0') return false;
    if (SetSimdLevel(level)) return true;
    std::string have;
    for (const std::string& name : SimdLevels()) have += ' ' + name;
    std::fprintf(stderr, "FJORD_SIMD=%s: this processor and build have:%s best\n", level,
                 have.c_str());
    std::exit(2);
  }();
  return applied;
}

}  // namespace internal
}  // namespace fjord
