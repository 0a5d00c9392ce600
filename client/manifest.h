// manifest.json beside the frames: what they were made from and what each of them is, so that a
// second run continues, a movie finds its rate, and a picture can be made again years later (C47).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

inline constexpr const char* kManifestName = "manifest.json";

struct ManifestFrame {
  std::string file;  // name in the manifest's folder
  std::string pixel_digest;
  std::string frame_key;
  uint64_t triangles_made = 0;  // depends on threads and tiles: RenderStats
  uint64_t milliseconds = 0;
};

struct Manifest {
  std::string name;  // file stem
  std::string scene_file;
  std::string scene_digest;
  std::string scene_json;  // every parameter, defaults included; very large shapes only by count
  double rate = 0;
  uint32_t frames_total = 0;  // of the animation
  std::map<uint32_t, ManifestFrame> frames;
};

// The head of a manifest, without frames.
Manifest DescribeScene(const v1::Scene& scene, const std::string& scene_file,
                       const std::string& scene_digest);

std::string ManifestText(const Manifest& manifest);

// scene_json is not read back. kInvalid where it is no manifest of this form.
Result<Manifest> ParseManifest(std::string_view bytes, const std::string& name);

}  // namespace fjord
