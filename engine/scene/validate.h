// What a scene must keep. Each check adds every defect it finds, with the field it is about.
//
// Order of use (load.cpp): counts and values on what was written; then, with shapes read and plain
// defaults filled in, the rest. All of it runs however many defects were found before.
#pragma once

#include <span>
#include <string>

#include "engine/scene/scene_shapes.h"
#include "engine/scene/source.h"

namespace fjord {

// Bounds on lists and on points written in the scene. False: too much, look no further.
bool CheckCounts(const v1::Scene& scene, SceneErrors* errors);

// Every number finite, not absurd and in its range; every enumerator known; every text printable.
// A value that is not is refused and another put in its place, so that the rest can be judged.
void CheckValues(v1::Scene* scene, SceneErrors* errors);

// Names, camera, lights, and all that follows.
void CheckScene(v1::Scene* scene, const SceneShapes& shapes, SceneErrors* errors);

// Parts of CheckScene.
void CheckObject(const v1::Scene& scene, int object, const SceneShapes& shapes,
                 SceneErrors* errors);
void CheckKeys(const v1::Scene& scene, int object, const SceneShapes& shapes, SceneErrors* errors);
// How the faces of a key differ from those of the key before; empty: not at all. number_of[v]: the
// vertex of the key before that vertex v has come from, both from 0.
std::string FaceDifference(const Geometry& before, const Geometry& now,
                           std::span<const uint32_t> number_of);
void CheckFractal(const v1::Scene& scene, int object, const SceneShapes& shapes,
                  SceneErrors* errors);
// A message that stands for a registry's entry, by the entry's table.
void CheckEntry(const google::protobuf::Message& entry, const Route& route, SceneErrors* errors);
// The same where the entry is not known yet: what every entry of the kind refuses.
void CheckForAnyEntry(const google::protobuf::Message& entry, const Route& route,
                      SceneErrors* errors);
bool IsPrintable(const std::string& text);
// Opens what tracks write to (camera.eye where only its track is given).
void CheckTracks(v1::Scene* scene, SceneErrors* errors);

}  // namespace fjord
