// The values of what a scene leaves out. After them the scene is complete: writing a default out
// changes nothing (C36).
#pragma once

#include <string>

#include "engine/scene/scene_shapes.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Before settings and files: names (the scene's from `file_name`), the sky, a sun where there are
// no lights; so --set can change single numbers of them.
void FillSurroundings(v1::Scene* scene, const std::string& file_name);
// Before shapes are made: the numbers of primitives.
void FillShapeNumbers(v1::Scene* scene);

// All that does not depend on where things are in the world.
void FillPlainDefaults(v1::Scene* scene, const SceneShapes& shapes);

// The camera, placed so that everything is in view in every frame of the shot, and the reach of
// local lights. Needs a scene without defects.
void FillViewDefaults(v1::Scene* scene, const SceneShapes& shapes);

}  // namespace fjord
