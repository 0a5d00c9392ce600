#include <google/protobuf/stubs/logging.h>

#include <array>

#include "tests/fuzz/harness.h"

namespace fjord::fuzz {

std::span<const Target> Targets() {
  static constexpr std::array<Target, 6> kTargets = {{
      {"shape", &RunShape},
      {"par", &RunPar},
      {"scene_text", &RunSceneText},
      {"scene_binary", &RunSceneBinary},
      {"picture", &RunPicture},
      {"wire", &RunWire},
  }};
  return kTargets;
}

void Prepare() { google::protobuf::SetLogHandler(nullptr); }

}  // namespace fjord::fuzz
