// From a scene file to a checked Scene message.
//
// Reading: Protobuf text format (syntax errors by line and column) or JSON (errors by path), by
// content. Then defaults, then validation: several defects at once, each with file:line:column.
// A loaded scene is complete: every optional number has a value, names are unique, references
// resolve, all numbers are finite and within engine/scene/limits.h.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Reads the bytes of an asset: by path relative to the scene (client), or by digest (worker).
using AssetReader = std::function<Result<std::string>(const v1::File& file)>;

struct Setting {
  std::string path;  // "objects[coast].fractal.H"
  std::string value;
};

// A scene, checked, with the bytes of its assets.
struct LoadedScene {
  v1::Scene scene;                            // complete; File.digest filled in
  std::map<std::string, std::string> assets;  // digest (hex) -> bytes
};

// `settings` are applied after parsing, before defaults. Several errors come back together.
struct LoadResult {
  LoadedScene loaded;
  Errors errors;
  std::vector<std::string> notes;  // lines for people: what was read, but not all of it
  bool ok() const { return errors.empty(); }
};

LoadResult LoadSceneFile(const std::string& path, std::span<const Setting> settings = {});
// The same from memory; `name` stands for the file in errors.
LoadResult LoadSceneText(const std::string& text, const std::string& name,
                         const AssetReader& assets, std::span<const Setting> settings = {});
// The wire form: a serialized Scene as a client made it complete; checked again in full.
LoadResult LoadSceneBinary(const std::string& bytes, const std::string& name,
                           const AssetReader& assets);

// Deterministic bytes of a complete scene; their SHA-256 is the scene digest.
std::string SerializeScene(const v1::Scene& scene);

}  // namespace fjord
