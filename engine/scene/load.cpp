#include "engine/scene/load.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <filesystem>

#include "engine/base/fpenv.h"
#include "engine/formats/read_bytes.h"
#include "engine/scene/defaults.h"
#include "engine/scene/limits.h"
#include "engine/scene/parse.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

void ApplySettings(v1::Scene* scene, std::span<const Setting> settings, SceneSource* source,
                   SceneErrors* errors) {
  for (const Setting& setting : settings) {
    const std::string place = "--set " + setting.path + "=" + setting.value;
    const auto fail = [&](const Error& error) {
      errors->AddAt(MakeError(ErrorCode::kUsage, error.message, {place, 0, 0}));
    };
    Result<FieldPath> path = ParseFieldPath(setting.path);
    if (!path) {
      fail(path.error());
      continue;
    }
    Result<Route> route = FindRoute(*scene, *path);
    if (!route) {
      fail(route.error());
      continue;
    }
    source->set.emplace_back(*route, place);
    if (Result<> done = SetFromText(scene, *route, setting.value); !done) fail(done.error());
  }
}

// Everything after parsing.
LoadResult Complete(v1::Scene scene, const AssetReader& assets, std::span<const Setting> settings,
                    SceneSource* source) {
  LoadResult result;
  v1::Scene& whole = result.loaded.scene;
  whole = std::move(scene);
  SceneErrors errors(&whole, source);
  if (!CheckCounts(whole, &errors)) {
    result.errors = errors.Take();
    return result;
  }
  FillSurroundings(&whole, source->name);
  ApplySettings(&whole, settings, source, &errors);
  CheckValues(&whole, &errors);
  if (errors.Full()) {  // not every value was looked at
    result.errors = errors.Take();
    return result;
  }
  FillShapeNumbers(&whole);
  const SceneShapes shapes = ReadShapes(&whole, assets, &result.loaded.assets, &errors);
  FillPlainDefaults(&whole, shapes);
  CheckScene(&whole, shapes, &errors);
  if (errors.empty()) {
    FillPlainDefaults(&whole, shapes);  // what tracks have brought in
    FillViewDefaults(&whole, shapes);
    CheckScene(&whole, shapes, &errors);
  }
  result.errors = errors.Take();
  result.notes = errors.TakeNotes();
  return result;
}

}  // namespace

LoadResult LoadSceneText(const std::string& text, const std::string& name,
                         const AssetReader& assets, std::span<const Setting> settings) {
  SetFloatEnvironment();
  SceneSource source;
  source.name = name;
  v1::Scene scene;
  Errors errors = ParseScene(text, &scene, &source);
  if (!errors.empty()) return {{}, std::move(errors)};
  return Complete(std::move(scene), assets, settings, &source);
}

LoadResult LoadSceneBinary(const std::string& bytes, const std::string& name,
                           const AssetReader& assets) {
  SetFloatEnvironment();
  SceneSource source;
  source.name = name;
  v1::Scene scene;
  Errors errors = ParseSceneBinary(bytes, &scene, &source);
  if (!errors.empty()) return {{}, std::move(errors)};
  return Complete(std::move(scene), assets, {}, &source);
}

LoadResult LoadSceneFile(const std::string& path, std::span<const Setting> settings) {
  Result<std::string> text = ReadBytes(path, limits::kSceneBytes);
  if (!text) return {{}, {text.error()}};
  const fs::path folder = fs::path(path).parent_path();
  const AssetReader reader = [&](const v1::File& file) -> Result<std::string> {
    if (file.path().empty()) return MakeError(ErrorCode::kNotFound, "the file has no path here");
    const std::string asset = (folder / file.path()).string();
    Result<std::string> bytes = ReadBytes(asset, limits::kAssetBytes);
    if (!bytes.ok()) return MakeError(bytes.error().code, asset + ": " + bytes.error().message);
    return bytes;
  };
  return LoadSceneText(*text, path, reader, settings);
}

std::string SerializeScene(const v1::Scene& scene) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    FJORD_CHECK(scene.SerializeToCodedStream(&coded), scene.name());
  }
  return bytes;
}

}  // namespace fjord
