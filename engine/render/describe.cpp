// What a picture's file says of itself (C47): the frame key, and the seed and every parameter of
// every object. Nothing here that is not in the key.
#include <charconv>
#include <string>

#include "engine/animation/coarse.h"
#include "engine/animation/frame_key.h"
#include "engine/fractal/registry.h"
#include "engine/render/frame_renderer.h"

namespace fjord {
namespace {

std::string Number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, end.ptr);
}

void Add(std::string* text, std::string_view name, const std::string& value) {
  if (!text->empty()) *text += ' ';
  *text += name;
  *text += '=';
  *text += value;
}

std::string DescribeFractal(const v1::FrameFractal& fractal) {
  const FractalSettings settings = FractalSettingsOf(fractal);
  const MethodInfo* method = FindFractalMethod(settings.method);
  std::string text;
  Add(&text, "method", settings.method);
  Add(&text, "version", std::to_string(method != nullptr ? method->version : 0));
  Add(&text, "seed", std::to_string(settings.seed));
  for (const Knob& knob : AllKnobs()) Add(&text, knob.name, Number(settings.*knob.value));
  Add(&text, "law", std::to_string(fractal.law()));
  Add(&text, "direction", std::to_string(fractal.direction()));
  Add(&text, "variant", std::to_string(fractal.variant()));
  Add(&text, "split", std::to_string(fractal.split()));
  Add(&text, "increments", std::to_string(fractal.increments()));
  Add(&text, "max_level", std::to_string(settings.max_level));
  Add(&text, "uniforms", std::to_string(settings.uniforms));
  Add(&text, "stretch", settings.stretch ? "1" : "0");
  Add(&text, "coast", settings.coast ? "1" : "0");
  Add(&text, "epsilon", Number(settings.fineness.epsilon));
  Add(&text, "pixels", Number(settings.fineness.pixels));
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
    if (!frame.object(i).has_fractal()) continue;
    info.emplace_back("object_" + std::to_string(i + 1),
                      DescribeFractal(frame.object(i).fractal()));
  }
  return info;
}

}  // namespace fjord
