// From a scene to the frame scene of one frame (S25): tracks evaluated, points moved along their
// paths, rest pose and fineness worked out for the whole shot. A pure function; no clock, no
// network.
//
// I1 At a key's frame every coarse point equals the key's bit for bit.
// I2 Rest pose, topology and fineness are the same in every frame of a shot.
// I3 The frame number reaches the frame scene only through the values it leads to.
#pragma once

#include <atomic>
#include <memory>

#include "engine/asset/asset.h"
#include "engine/base/result.h"
#include "engine/scene/load.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

// A scene made ready for inbetweening: shapes read, keys brought to one topology. Immutable; share
// it between threads.
class Animation {
 public:
  // Costs what shapes and tracks cost, however many frames the shot has. kCancelled soon after
  // `cancel` (may be null) is set.
  static Result<std::shared_ptr<const Animation>> Make(LoadedScene scene,
                                                       const std::atomic<bool>* cancel = nullptr);
  virtual ~Animation() = default;

  virtual const v1::Scene& scene() const = 0;
  virtual uint32_t first_frame() const = 0;
  virtual uint32_t last_frame() const = 0;
  // frame in first_frame()..last_frame(), else kInvalid. `assets`, where it is not null, gets the
  // lists that the frame scene only names; a key can do without.
  virtual Result<v1::FrameScene> Inbetween(uint32_t frame, AssetSet* assets) const = 0;
};

}  // namespace fjord
