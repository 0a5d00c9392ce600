// What a scene must keep. Each check adds every defect it finds, with the field it is about.
//
// Order of use (load.cpp): counts and values on what was written; then, with shapes read and plain
// defaults filled in, the rest.
#pragma once

#include "engine/scene/scene_shapes.h"
#include "engine/scene/source.h"

namespace fjord {

// Bounds on lists and on points written in the scene. False: too much, look no further.
bool CheckCounts(const v1::Scene& scene, SceneErrors* errors);

// Every number finite, not absurd and in its range; every enumerator known; every text printable.
void CheckValues(const v1::Scene& scene, SceneErrors* errors);

// Names, camera, lights, and all that follows.
void CheckScene(v1::Scene* scene, const SceneShapes& shapes, SceneErrors* errors);

// Parts of CheckScene.
void CheckObject(const v1::Scene& scene, int object, const SceneShapes& shapes,
                 SceneErrors* errors);
void CheckKeys(const v1::Scene& scene, int object, const SceneShapes& shapes, SceneErrors* errors);
void CheckFractal(const v1::Scene& scene, int object, const SceneShapes& shapes,
                  SceneErrors* errors);
// Opens what tracks write to (camera.eye where only its track is given).
void CheckTracks(v1::Scene* scene, SceneErrors* errors);

}  // namespace fjord
