#include "engine/animation/frame_key.h"

#include <map>

#include "engine/animation/frame_geometry.h"
#include "engine/animation/walk.h"
#include "engine/fractal/registry.h"

namespace fjord {

Result<std::string> FrameKeyBytes(const v1::FrameScene& frame) {
  std::map<std::string, uint32_t> used;  // sorted by name
  for (int i = 0; i < frame.object_size(); ++i) {
    if (Result<> form = CheckGeometryForm(frame.object(i)); !form) return form.error();
    if (!frame.object(i).has_fractal()) continue;
    const std::string& name = frame.object(i).fractal().method();
    const MethodInfo* method = FindFractalMethod(name);
    if (method == nullptr) {
      return Invalid("object " + std::to_string(i + 1) +
                     " of the frame scene uses fractal method \"" + name +
                     "\", which this version does not have");
    }
    used["fractal/" + name] = method->version;
  }
  std::string bytes = "fjord-frame 1\ncore " + std::to_string(kCoreShapeVersion) + "\n";
  for (const auto& [name, version] : used) bytes += name + " " + std::to_string(version) + "\n";
  if (Result<> walked = AppendWalk(frame, bytes); !walked) return walked.error();
  return bytes;
}

Result<Digest> FrameKey(const v1::FrameScene& frame) {
  Result<std::string> bytes = FrameKeyBytes(frame);
  if (!bytes) return bytes.error();
  return Sha256Of(*bytes);
}

}  // namespace fjord
