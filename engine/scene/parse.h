// From bytes to a Scene message, nothing checked yet but the syntax and the names of fields.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/scene/source.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Text form or, if the first character is {, JSON. Fills source.form and source.tree; source.name
// is used in errors. Several errors where the reader can go on (unknown fields).
Errors ParseScene(const std::string& text, v1::Scene* scene, SceneSource* source);

// The wire form. Fields that this version does not know are errors.
Errors ParseSceneBinary(const std::string& bytes, v1::Scene* scene, SceneSource* source);

}  // namespace fjord
