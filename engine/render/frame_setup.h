// Everything about a frame that its tiles share, worked out once. Immutable; free to share.
#pragma once

#include <optional>
#include <vector>

#include "engine/render/built_frame.h"
#include "engine/render/cull.h"
#include "engine/render/raster.h"
#include "engine/render/shade.h"
#include "engine/render/view.h"
#include "engine/render/view_plane.h"

namespace fjord {

// An object at one of its places.
struct ObjectSetup {
  uint32_t object = 0;  // of BuiltFrame::objects
  Projection to;
  Attributes attributes;
  double line_width = 1;
  std::optional<ViewPlane> fill;  // closed curves that are filled
  Surface surface;
  HitGeometry geometry;
};

struct FrameSetup {
  explicit FrameSetup(const BuiltFrame& built);

  const BuiltFrame& frame;  // must outlive this
  View view;
  std::vector<ObjectSetup> objects;
  std::vector<CullObject> cull;
  std::vector<ShadeLight> lights;
  std::optional<ViewPlane> sea;
  Surface sea_surface;
  HitGeometry sea_geometry;
};

}  // namespace fjord
