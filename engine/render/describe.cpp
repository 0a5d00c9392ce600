// What a picture's file says of itself (C47): the frame key, and the seed and every parameter of
// every object. Nothing here that is not in the key.
#include <string>

#include "engine/animation/frame_key.h"
#include "engine/fractal/registry.h"
#include "engine/render/frame_renderer.h"
#include "engine/scene/parameters.h"
#include "engine/texture/registry.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

void Add(std::string* text, std::string_view name, const std::string& value) {
  if (!text->empty()) *text += ' ';
  *text += name;
  *text += '=';
  *text += value;
}

// Every value of the entry that has an effect.
void AddKnobs(const EntryInfo& info, const Parameters& parameters, std::string* text) {
  std::vector<KnobDefect> defects;
  const std::any settings = info.knobs.Read(ValuesOf(parameters), info.name, &defects);
  for (const Knob& knob : info.knobs.rows()) {
    if (knob.Works(settings)) Add(text, knob.name, knob.ValueText(knob.Get(settings)));
  }
}

std::string DescribeFractal(const v1::FrameFractal& fractal) {
  const MethodInfo* method = FindFractalMethod(fractal.method());
  std::string text;
  Add(&text, "method", fractal.method());
  Add(&text, "version", std::to_string(method != nullptr ? method->version : 0));
  Add(&text, "seed", std::to_string(fractal.seed()));
  Add(&text, "split", v1::Fractal::Split_Name(static_cast<v1::Fractal::Split>(fractal.split())));
  Add(&text, "max_level", std::to_string(fractal.max_level()));
  Add(&text, "epsilon", NumberText(fractal.fineness().epsilon()));
  Add(&text, "pixels", NumberText(fractal.fineness().pixels()));
  if (method != nullptr) AddKnobs(*method, fractal.parameter(), &text);
  return text;
}

std::string DescribeStage(const v1::FrameStage& stage) {
  const StageInfo* info = FindTextureStage(stage.kind());
  std::string text;
  Add(&text, "kind", stage.kind());
  Add(&text, "version", std::to_string(info != nullptr ? info->version : 0));
  if (info != nullptr) AddKnobs(*info, stage.parameter(), &text);
  return text;
}

}  // namespace

Result<PictureInfo> DescribeFrame(const v1::FrameScene& frame) {
  const Result<Digest> key = FrameKey(frame);
  if (!key) return key.error();
  PictureInfo info;
  info.emplace_back("frame_key", key->Hex());
  info.emplace_back("core_version", std::to_string(kCoreShapeVersion));
  info.emplace_back("size", std::to_string(frame.output().width()) + "x" +
                                std::to_string(frame.output().height()));
  info.emplace_back("samples", std::to_string(frame.output().samples()));
  for (int i = 0; i < frame.object_size(); ++i) {
    const v1::FrameObject& object = frame.object(i);
    const std::string name = "object_" + std::to_string(i + 1);
    if (object.has_fractal()) info.emplace_back(name, DescribeFractal(object.fractal()));
    for (int s = 0; s < object.material().stage_size(); ++s) {
      info.emplace_back(name + "_stage_" + std::to_string(s + 1),
                        DescribeStage(object.material().stage(s)));
    }
  }
  return info;
}

}  // namespace fjord
