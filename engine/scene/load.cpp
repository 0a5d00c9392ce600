#include "engine/scene/load.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/scene/defaults.h"
#include "engine/scene/limits.h"
#include "engine/scene/parse.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

Result<std::string> ReadFile(const fs::path& path, uint64_t most) {
  const std::string name = path.string();
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) {
    return MakeError(ErrorCode::kNotFound, "there is no file " + name);
  }
  if (fs::is_directory(status)) return MakeError(ErrorCode::kIo, name + " is a folder, not a file");
  const uint64_t size = fs::is_regular_file(status) ? fs::file_size(path, code) : 0;
  if (size > most) {
    return MakeError(ErrorCode::kLimit, name + " has " + std::to_string(size) + " bytes; at most " +
                                            std::to_string(most) + " are read");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  char buffer[1 << 16];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0) {
    bytes.append(buffer, static_cast<size_t>(file.gcount()));
    if (bytes.size() > most) return MakeError(ErrorCode::kLimit, name + " is too big");
  }
  if (!file.eof()) {
    const std::string why = errno != 0 ? std::strerror(errno) : "reading failed";
    return MakeError(ErrorCode::kIo, "cannot read " + name + ": " + why);
  }
  return bytes;
}

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
  return result;
}

}  // namespace

LoadResult LoadSceneText(const std::string& text, const std::string& name,
                         const AssetReader& assets, std::span<const Setting> settings) {
  SceneSource source;
  source.name = name;
  v1::Scene scene;
  Errors errors = ParseScene(text, &scene, &source);
  if (!errors.empty()) return {{}, std::move(errors)};
  return Complete(std::move(scene), assets, settings, &source);
}

LoadResult LoadSceneBinary(const std::string& bytes, const std::string& name,
                           const AssetReader& assets) {
  SceneSource source;
  source.name = name;
  v1::Scene scene;
  Errors errors = ParseSceneBinary(bytes, &scene, &source);
  if (!errors.empty()) return {{}, std::move(errors)};
  return Complete(std::move(scene), assets, {}, &source);
}

LoadResult LoadSceneFile(const std::string& path, std::span<const Setting> settings) {
  Result<std::string> text = ReadFile(path, limits::kSceneBytes);
  if (!text) return {{}, {text.error()}};
  const fs::path folder = fs::path(path).parent_path();
  const AssetReader reader = [&](const v1::File& file) -> Result<std::string> {
    if (file.path().empty()) return MakeError(ErrorCode::kNotFound, "the file has no path here");
    return ReadFile(folder / file.path(), limits::kAssetBytes);
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
