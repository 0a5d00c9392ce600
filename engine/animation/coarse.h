// From the messages of a frame scene to the plain values that fractal methods take. Render, export
// and the animation check all come through here, so that they prepare the same object.
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/fractal/method.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

Fineness FinenessOf(const v1::FrameFineness& fineness);

// kInvalid where there is no such method or its table refuses a value.
Result<MethodSettings> MethodSettingsOf(const v1::FrameFractal& fractal);

// The object's fractal, prepared by its method. Needs object.has_fractal() and
// all lists written out (frame_geometry.h).
Result<std::unique_ptr<PreparedFractal>> PrepareFractal(const v1::FrameObject& object);

}  // namespace fjord
