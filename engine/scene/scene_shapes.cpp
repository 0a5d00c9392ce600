#include "engine/scene/scene_shapes.h"

#include <utility>

#include "engine/base/digest.h"

namespace fjord {
namespace {

// Reads the file of a shape once; false where an error was added.
bool ReadAsset(v1::File* file, const Route& route, const AssetReader& reader,
               std::map<std::string, std::string>* assets, SceneErrors* errors) {
  if (file->path().empty() && file->digest().empty()) {
    errors->Add(route, "path is missing; say which file");
    return false;
  }
  if (!file->digest().empty() && !IsDigestHex(file->digest())) {
    errors->Add(route.Then("digest"), "not a digest: 64 hexadecimal digits");
    return false;
  }
  if (!file->digest().empty() && assets->count(file->digest()) > 0) return true;
  Result<std::string> bytes = reader(*file);
  if (!bytes) {
    errors->Add(file->path().empty() ? route : route.Then("path"), bytes.error().message,
                bytes.error().code);
    return false;
  }
  const std::string digest = Sha256Of(*bytes).Hex();
  if (!file->digest().empty() && file->digest() != digest) {
    errors->Add(route.Then("digest"), "the file has digest " + digest +
                                          "; it is not the file that the scene was made with");
    return false;
  }
  file->set_digest(digest);
  assets->emplace(digest, std::move(*bytes));
  return true;
}

}  // namespace

Box SceneShapes::BoundsOf(size_t object) const {
  Box box;
  for (const auto& geometry : of[object]) {
    if (!geometry) continue;
    for (const Vec3& point : geometry->points) box.Add(point);
  }
  return box;
}

const Geometry* SceneShapes::FirstOf(size_t object) const {
  for (const auto& geometry : of[object]) {
    if (geometry) return &*geometry;
  }
  return nullptr;
}

std::vector<ShapeEntry> ShapesOf(v1::Scene* scene, int object) {
  const Route route = Route().Then("objects", object);
  v1::Object* message = scene->mutable_objects(object);
  std::vector<ShapeEntry> entries;
  if (message->has_shape()) entries.push_back({message->mutable_shape(), route.Then("shape")});
  if (message->has_shape()) return entries;
  for (int k = 0; k < message->key_size(); ++k) {
    entries.push_back(
        {message->mutable_key(k)->mutable_shape(), route.Then("key", k).Then("shape")});
  }
  return entries;
}

SceneShapes ReadShapes(v1::Scene* scene, const AssetReader& reader,
                       std::map<std::string, std::string>* assets, SceneErrors* errors) {
  SceneShapes shapes;
  for (int i = 0; i < scene->objects_size(); ++i) {
    auto& geometries = shapes.of.emplace_back();
    for (const auto& [shape, route] : ShapesOf(scene, i)) {
      geometries.emplace_back();
      if (errors->Full()) continue;
      const bool is_file = shape->kind_case() == v1::Shape::kFile;
      if (is_file &&
          !ReadAsset(shape->mutable_file(), route.Then("file"), reader, assets, errors)) {
        continue;
      }
      Result<Geometry> geometry = DecodeShape(*shape, *assets);
      if (geometry) {
        geometries.back() = std::move(*geometry);
      } else if (geometry.error().place.file.empty()) {
        errors->Add(route, geometry.error().message, geometry.error().code);
      } else {
        errors->AddAt(geometry.error());
      }
    }
  }
  return shapes;
}

}  // namespace fjord
