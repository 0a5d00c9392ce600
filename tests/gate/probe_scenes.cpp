// Scenes from their text to their samples: loading, inbetweening, frame key, pictures of every
// format.
#include <algorithm>
#include <filesystem>
#include <numeric>

#include "engine/animation/frame_key.h"
#include "engine/animation/inbetween.h"
#include "engine/base/random.h"
#include "engine/render/frame_renderer.h"
#include "engine/scene/load.h"
#include "tests/gate/probe.h"

namespace fjord::gate {
namespace {

constexpr const char* kFormats[] = {"png8", "png16", "half", "float"};

// The same object, its faces in another order.
void ShuffleFaces(v1::FrameObject* object) {
  std::vector<std::vector<uint32_t>> faces;
  int at = 0;
  for (const uint32_t size : object->face_size()) {
    std::vector<uint32_t> face;
    for (uint32_t i = 0; i < size; ++i) face.push_back(object->face_vertex(at++));
    faces.push_back(std::move(face));
  }
  for (size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[Mix64(i) % i]);
  object->clear_face_size();
  object->clear_face_vertex();
  for (const auto& face : faces) {
    object->add_face_size(static_cast<uint32_t>(face.size()));
    for (const uint32_t v : face) object->add_face_vertex(v);
  }
}

// As this run says, and as users render: in the tiles that the program chooses, which depend on the
// number of threads. One picture, or the item has failed.
void ProbeAsUsersRender(const std::string& item, const v1::FrameScene& frame,
                        const RenderOptions& own, Report& report) {
  std::vector<RenderOptions> ways = {own};
  for (const int threads : {1, 2, 3, 8}) {
    ways.emplace_back();
    ways.back().threads = threads;
    ways.back().assets = own.assets;
  }
  std::string first;
  for (const RenderOptions& way : ways) {
    const auto picture = RenderFrame(frame, way);
    if (!picture.ok()) return report.Fail(item, picture.error().ToString());
    const Digest digest = PixelDigest(picture.value().picture);
    if (first.empty()) {
      first = digest.Hex();
      report.Item(item, digest);
    } else if (digest.Hex() != first) {
      return report.Fail(item, std::to_string(way.threads) + " threads give another picture");
    }
  }
}

void ProbeFrame(const std::string& name, v1::FrameScene frame, const AssetSet& assets,
                const Options& options, Report& report) {
  const auto key = FrameKey(frame);
  if (!key.ok()) {
    report.Fail(name + "/key", key.error().ToString());
    return;
  }
  report.Item(name + "/key", key.value());
  if (options.shuffle) {
    for (v1::FrameObject& object : *frame.mutable_object()) ShuffleFaces(&object);
  }
  RenderOptions render;
  render.threads = options.threads;
  render.assets = &assets;
  render.tile_size = options.tile;
  render.patch_size = options.patch;
  constexpr uint32_t kWide = 1920;
  if (frame.output().width() >= kWide) {
    const char* format = kFormats[frame.output().format()];
    return ProbeAsUsersRender(name + '/' + format, frame, render, report);
  }
  // Only EXR pictures have layers.
  const uint32_t first = frame.output().layer_size() > 0 ? 2 : 0;
  for (uint32_t format = first; format < 4; ++format) {
    // One format alone at more than one sample: they share all but the last step.
    frame.mutable_output()->set_format(format);
    frame.mutable_output()->set_samples(format == 3 ? 4 : 1);
    const std::string item = name + '/' + kFormats[format];
    const auto picture = RenderFrame(frame, render);
    if (!picture.ok()) {
      report.Fail(item, picture.error().ToString());
      continue;
    }
    const auto& bytes = picture.value().picture.bytes;
    const auto differs = [&](uint8_t byte) { return byte != bytes[0]; };
    if (std::none_of(bytes.begin(), bytes.end(), differs)) report.Fail(item, "an empty picture");
    report.Item(item, PixelDigest(picture.value().picture));
  }
}

void ProbeScene(const std::string& path, const std::string& name, const Options& options,
                Report& report) {
  LoadResult loaded = LoadSceneFile(path);
  for (const Error& error : loaded.errors) report.Fail(name, error.ToString());
  if (!loaded.ok()) return;
  const auto animation = Animation::Make(std::move(loaded.loaded));
  if (!animation.ok()) {
    report.Fail(name, animation.error().ToString());
    return;
  }
  const Animation& shot = *animation.value();
  for (uint32_t number = shot.first_frame(); number <= shot.last_frame(); ++number) {
    const std::string item = name + '/' + std::to_string(number);
    AssetSet assets;
    const auto frame = shot.Inbetween(number, &assets);
    if (!frame.ok()) {
      report.Fail(item, frame.error().ToString());
      continue;
    }
    ProbeFrame(item, frame.value(), assets, options, report);
  }
}

}  // namespace

void ProbeScenes(const Options& options, Report& report) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(options.scenes)) {
    if (entry.path().extension() == ".scene") paths.push_back(entry.path());
  }
  if (paths.empty()) report.Fail("scene", "no scenes in " + options.scenes);
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    const std::string name = "scene/" + path.stem().string();
    if (report.Wants(name)) ProbeScene(path.string(), name, options, report);
  }
}

}  // namespace fjord::gate
