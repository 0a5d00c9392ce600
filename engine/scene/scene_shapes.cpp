#include "engine/scene/scene_shapes.h"

#include <set>
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

// A picture has none of what shapes have.
bool CheckPicture(const v1::File& file, const Route& route, SceneErrors* errors) {
  const std::pair<const char*, bool> fields[] = {{"outline", file.outline()},
                                                 {"curve", file.curve() > 0},
                                                 {"spacing", file.has_spacing()},
                                                 {"up", file.up() != v1::File::Z}};
  for (const auto& [field, is_given] : fields) {
    if (!is_given) continue;
    errors->Add(route.Then("heights").Then("file").Then(field),
                "a picture of heights has no " + std::string(field) + "; files of shapes have");
    return false;
  }
  return true;
}

// What is written in the scene, so that each defect has its place; false where there is one.
bool CheckWritten(const v1::Shape& shape, const Route& route, SceneErrors* errors) {
  if (shape.has_primitive()) {
    const v1::Primitive& primitive = shape.primitive();
    const bool ball =
        primitive.kind() == v1::Primitive::SPHERE || primitive.kind() == v1::Primitive::ELLIPSOID;
    if (primitive.has_base() && !ball) {
      errors->Add(
          route.Then("primitive").Then("base"),
          v1::Primitive::Kind_Name(primitive.kind()) + " has no base; SPHERE and ELLIPSOID have");
      return false;
    }
    return !errors->RefusedWithin(route);
  }
  if (shape.has_file()) return !errors->RefusedWithin(route);
  if (shape.heights().has_file()) return CheckPicture(shape.heights().file(), route, errors);
  if (!shape.has_mesh()) return true;
  const v1::Mesh& mesh = shape.mesh();
  const auto count = static_cast<uint32_t>(mesh.point_size());
  bool sound = true;
  const auto fail = [&](int face, int corner, const std::string& message) {
    const Route place = route.Then("mesh").Then("face", face);
    errors->Add(corner < 0 ? place : place.Then("v", corner), message);
    sound = false;
  };
  // As the readers of files have it: what is beyond 1 was not divided by 255.
  for (int v = 0; v < mesh.color_size() && !errors->Full(); ++v) {
    const v1::Color& color = mesh.color(v);
    if (!(color.r() > 1 || color.g() > 1 || color.b() > 1)) continue;
    errors->Add(route.Then("mesh").Then("color", v),
                "a vertex has a colour that is not within 0 to 1; divide bytes by 255");
    return false;
  }
  for (int f = 0; f < mesh.face_size() && !errors->Full(); ++f) {
    const v1::Face& face = mesh.face(f);
    if (face.v_size() < 3)
      fail(f, -1, std::to_string(face.v_size()) + " corners; a face needs three or more");
    for (int i = 0; i < face.v_size(); ++i) {
      if (face.v(i) >= 1 && face.v(i) <= count) continue;
      fail(f, i,
           "there is no vertex " + std::to_string(face.v(i)) + "; the mesh has vertices 1 to " +
               std::to_string(count));
    }
  }
  return sound;
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
  std::set<std::string> single;  // files of which curves are taken one by one
  std::set<std::string> noted;   // files whose notes have been given
  for (int i = 0; i < scene->objects_size(); ++i) {
    for (const auto& [shape, route] : ShapesOf(scene, i)) {
      if (shape->file().curve() > 0) single.insert(shape->file().path());
    }
  }
  for (int i = 0; i < scene->objects_size(); ++i) {
    auto& geometries = shapes.of.emplace_back();
    for (const auto& [shape, route] : ShapesOf(scene, i)) {
      geometries.emplace_back();
      if (errors->Full()) continue;
      if (!CheckWritten(*shape, route, errors)) continue;
      if (shape->has_file() &&
          !ReadAsset(shape->mutable_file(), route.Then("file"), reader, assets, errors)) {
        continue;
      }
      if (shape->heights().has_file() &&
          !ReadAsset(shape->mutable_heights()->mutable_file(), route.Then("heights").Then("file"),
                     reader, assets, errors)) {
        continue;
      }
      Result<Geometry> geometry = DecodeShape(*shape, *assets);
      const bool needs_mesh = scene->objects(i).has_fractal() || !scene->objects(i).has_shape();
      if (geometry && needs_mesh) geometry = WithMesh(std::move(*geometry));
      if (geometry && !geometry->left_out.empty() && single.count(shape->file().path()) == 0) {
        errors->Note(route.Then("file"), geometry->left_out);
      }
      if (geometry && noted.insert(shape->file().path()).second) {
        for (const std::string& note : geometry->notes) errors->Note(route.Then("file"), note);
      }
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
