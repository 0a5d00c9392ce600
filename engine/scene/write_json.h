// A scene as JSON in the scene language, which reads back to the same scene.
#pragma once

#include <string>

#include "fjord/v1/scene.pb.h"

namespace fjord {

std::string SceneJson(const v1::Scene& scene);

}  // namespace fjord
