// Heights of a shape: from a picture's file, or written in the scene.
#pragma once

#include <map>
#include <string>

#include "engine/base/result.h"
#include "engine/geometry/heights.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Needs defaults filled in. `assets`: digest to bytes. Of a picture the first channel counts: 0 to
// 1 for PNG, as it is for EXR; its top row has the largest y. Written samples start at the least y.
Result<HeightField> DecodeHeights(const v1::Heights& heights,
                                  const std::map<std::string, std::string>& assets);

}  // namespace fjord
