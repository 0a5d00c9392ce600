// All shapes of a scene, decoded once for defaults and validation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/load.h"
#include "engine/scene/shapes.h"
#include "engine/scene/source.h"

namespace fjord {

// of[object] holds one geometry for each key, or one where the object has a single shape; nothing
// where the shape could not be read (an error has been added then).
struct SceneShapes {
  std::vector<std::vector<std::optional<Geometry>>> of;

  // Every point of the object in its keys; object space.
  Box BoundsOf(size_t object) const;
  // The first geometry of the object that could be read, or null.
  const Geometry* FirstOf(size_t object) const;
};

// The shape messages of an object with their routes: its keys', or its own.
struct ShapeEntry {
  v1::Shape* shape;
  Route route;
};
std::vector<ShapeEntry> ShapesOf(v1::Scene* scene, int object);

// Reads every file that the scene names (filling in File.digest) and decodes every shape.
SceneShapes ReadShapes(v1::Scene* scene, const AssetReader& reader,
                       std::map<std::string, std::string>* assets, SceneErrors* errors);

}  // namespace fjord
