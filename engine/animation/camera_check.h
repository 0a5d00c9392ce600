// Does the camera of a shot see something in every frame?
#pragma once

#include <optional>
#include <string>

#include "engine/scene/track.h"

namespace fjord {

struct BlindFrame {
  uint32_t frame = 0;
  std::string defect;  // CameraState::Defect
};

// The first frame in which the camera, moved by its tracks, cannot see. Stretches of frames in
// which that cannot be are passed over as a whole. A camera that is almost blind all along is
// looked at in its first frames only: whoever makes a frame asks CameraState::Defect again.
// `scratch`: the scene, objects may be left out; the tracks are applied to it.
std::optional<BlindFrame> FindBlindFrame(const TrackSet& camera, uint32_t frames,
                                         v1::Scene* scratch);

}  // namespace fjord
