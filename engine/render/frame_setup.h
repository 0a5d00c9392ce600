// Everything about a frame that its tiles share, worked out once. Immutable; free to share.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/render/built_frame.h"
#include "engine/render/coarse_attributes.h"
#include "engine/render/cull.h"
#include "engine/render/exposure.h"
#include "engine/render/raster.h"
#include "engine/render/shade.h"
#include "engine/render/shadow_map.h"
#include "engine/render/view.h"
#include "engine/render/view_plane.h"

namespace fjord {

// An object at one of its places.
struct ObjectSetup {
  Projection to;
  Keep keep = Keep::kRecords;
  double line_width = 1;
  std::optional<ViewPlane> fill;  // closed curves that are filled
  bool translucent = false;       // drawn after what is opaque, over it (fragments.h)
};

// How many samples one hit stands for: what is smooth needs no light of its own for each.
enum class Grain : uint8_t { kSample, kPixel, kRow };

enum class OwnerKind : uint8_t { kObject, kSea, kSky };

// Whom a sample can belong to, and how its hits are made into colour.
struct Owner {
  OwnerKind kind = OwnerKind::kObject;
  uint32_t object = 0;                 // of BuiltFrame::objects; of objects alone, as what follows
  Transform transform = kNoTransform;  // of this place of the object
  Grain grain = Grain::kSample;
  Surface surface;
  HitGeometry geometry;
  std::shared_ptr<const CoarseAttributes> attributes;  // null where none is read
  float opacity = 1;                                   // of objects
};

struct FrameSetup {
  explicit FrameSetup(const BuiltFrame& built);

  const BuiltFrame& frame;  // must outlive this
  View view;
  Exposure exposure;
  std::vector<ObjectSetup> objects;
  std::vector<Owner> owners;  // places of objects as `objects`, the sea, the sky
  uint32_t sea_owner = 0, sky_owner = 0;
  std::vector<CullObject> cull;
  std::vector<ShadeLight> lights;
  std::vector<ShadowMap> shadows;  // by ShadeLight::shadow; empty until DrawShadows
  std::optional<ViewPlane> sea;

  uint32_t channels() const { return frame.alpha ? 4 : 3; }
};

}  // namespace fjord
