// From a scene with its tracks applied to the parts of a frame scene. A value at its default is
// left at zero, so that equal pictures have equal keys.
#pragma once

#include "engine/base/result.h"
#include "fjord/v1/frame.pb.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Output, camera, background, lights and sea.
void AssembleSurroundings(const v1::Scene& now, v1::FrameScene* frame);

// All but the shape (frame_geometry.h) and the fractal. `curve`: it is drawn as strokes.
Result<> AssembleObject(const v1::Object& now, bool curve, uint32_t picture_height,
                        v1::FrameObject* object);

// What texture stages read beside the surface itself, where any does: the rule of (u,v) that the
// shape of the rest pose has, and the time. `whole`: the object as it is in the scene.
void AssembleReads(const v1::Object& whole, uint32_t number, v1::FrameObject* object,
                   v1::FrameScene* frame);

// All but the fineness. kInvalid where tracks have taken values together out of bounds.
Result<> AssembleFractal(const v1::Fractal& now, v1::FrameFractal* fractal);

}  // namespace fjord
