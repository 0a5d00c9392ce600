#include "client/manifest.h"

#include <nlohmann/json.hpp>

#include "engine/animation/frame_key.h"
#include "engine/base/digest.h"
#include "engine/scene/write_json.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kForm = "fjord-manifest 1";
// Shapes written into the scene with more points than this are recorded by count only.
constexpr int kMostInlinePoints = 2000;

void ShortenShape(v1::Shape* shape) {
  if (shape->has_mesh() && shape->mesh().point_size() > kMostInlinePoints) {
    shape->mutable_mesh()->clear_point();
    shape->mutable_mesh()->clear_face();
    shape->mutable_mesh()->clear_color();
  }
  if (shape->has_polyline() && shape->polyline().point_size() > kMostInlinePoints)
    shape->mutable_polyline()->clear_point();
}

std::string TextOf(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

template <typename Number>
Number NumberOf(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? it->get<Number>() : Number{};
}

}  // namespace

Manifest DescribeScene(const v1::Scene& scene, const std::string& scene_file,
                       const std::string& scene_digest) {
  Manifest manifest;
  manifest.name = scene.name();
  manifest.scene_file = scene_file;
  manifest.scene_digest = scene_digest;
  manifest.rate = scene.output().rate();
  manifest.frames_total = scene.output().frames();
  v1::Scene shown = scene;
  for (v1::Object& object : *shown.mutable_objects()) {
    if (object.has_shape()) ShortenShape(object.mutable_shape());
    for (v1::Key& key : *object.mutable_key()) ShortenShape(key.mutable_shape());
  }
  manifest.scene_json = SceneJson(shown);
  return manifest;
}

std::string ManifestText(const Manifest& manifest) {
  Json json;
  json["form"] = kForm;
  json["name"] = manifest.name;
  json["engine"] = {{"version", kVersion}, {"core", kCoreShapeVersion}};
  json["rate"] = manifest.rate;
  json["frames_total"] = manifest.frames_total;
  Json scene = Json::parse(manifest.scene_json, nullptr, false);
  json["scene"] = {{"file", manifest.scene_file}, {"digest", manifest.scene_digest}};
  json["scene"]["parameters"] = scene.is_discarded() ? Json::object() : std::move(scene);
  Json frames = Json::array();
  for (const auto& [number, frame] : manifest.frames) {
    frames.push_back({{"frame", number},
                      {"file", frame.file},
                      {"pixel_digest", frame.pixel_digest},
                      {"frame_key", frame.frame_key},
                      {"triangles_made", frame.triangles_made},
                      {"ms", frame.milliseconds}});
  }
  json["frames"] = std::move(frames);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Manifest> ParseManifest(std::string_view bytes, const std::string& name) {
  const Json json = Json::parse(bytes, nullptr, false);
  if (!json.is_object() || TextOf(json, "form") != kForm)
    return Invalid("this is no manifest of Fjord", {name, 0, 0});
  Manifest manifest;
  manifest.name = TextOf(json, "name");
  manifest.rate = NumberOf<double>(json, "rate");
  manifest.frames_total = NumberOf<uint32_t>(json, "frames_total");
  if (const auto scene = json.find("scene"); scene != json.end() && scene->is_object()) {
    manifest.scene_file = TextOf(*scene, "file");
    manifest.scene_digest = TextOf(*scene, "digest");
  }
  const auto frames = json.find("frames");
  if (frames == json.end() || !frames->is_array())
    return Invalid("the manifest has no list of frames", {name, 0, 0});
  for (const Json& entry : *frames) {
    ManifestFrame frame;
    frame.file = TextOf(entry, "file");
    frame.pixel_digest = TextOf(entry, "pixel_digest");
    frame.frame_key = TextOf(entry, "frame_key");
    frame.triangles_made = NumberOf<uint64_t>(entry, "triangles_made");
    frame.milliseconds = NumberOf<uint64_t>(entry, "ms");
    const bool plain_name = !frame.file.empty() && frame.file.find('/') == std::string::npos;
    if (!plain_name || !IsDigestHex(frame.pixel_digest) || !IsDigestHex(frame.frame_key))
      return Invalid("the manifest has a frame without file, pixel digest or frame key",
                     {name, 0, 0});
    manifest.frames[NumberOf<uint32_t>(entry, "frame")] = std::move(frame);
  }
  return manifest;
}

}  // namespace fjord
