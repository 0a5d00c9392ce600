#include "engine/scene/ranges.h"

#include <map>
#include <string_view>

#include "engine/scene/limits.h"

namespace fjord {
namespace {

struct Row {
  std::string_view field;
  NumberRange range;
};

constexpr double kLargest = limits::kLargest;

constexpr Row kRows[] = {
    {"fjord.v1.Output.width", {1, limits::kPictureSide, false}},
    {"fjord.v1.Output.height", {1, limits::kPictureSide, false}},
    {"fjord.v1.Output.frames", {1, limits::kFrames, false}},
    {"fjord.v1.Output.rate", {0, 1000, true}},
    {"fjord.v1.Camera.fov", {1, 170, false}},
    {"fjord.v1.Camera.view_height", {0, kLargest, true}},
    {"fjord.v1.Camera.near", {0, kLargest, true}},
    {"fjord.v1.Color.r", {0, 1e6, false}},
    {"fjord.v1.Color.g", {0, 1e6, false}},
    {"fjord.v1.Color.b", {0, 1e6, false}},
    {"fjord.v1.Light.range", {0, kLargest, true}},
    {"fjord.v1.Light.intensity", {0, 1e6, false}},
    {"fjord.v1.Light.shadow_detail", {0, kLargest, true}},
    {"fjord.v1.Haze.density", {0, 1e9, false}},
    {"fjord.v1.Sea.specular", {0, 1000, false}},
    {"fjord.v1.Sea.shininess", {1, 200, false}},
    {"fjord.v1.Key.frame", {1, limits::kFrames, false}},
    {"fjord.v1.Primitive.radius", {0, kLargest, true}},
    {"fjord.v1.Primitive.tube", {0, kLargest, true}},
    {"fjord.v1.Primitive.radii", {0, kLargest, true}},
    {"fjord.v1.Primitive.segments", {1, 16'000'000, false}},
    {"fjord.v1.Primitive.rings", {1, 16'000'000, false}},
    {"fjord.v1.File.spacing", {0, kLargest, true}},
    {"fjord.v1.Heights.pixels", {0, 1e6, true}},
    {"fjord.v1.Heights.epsilon", {0, kLargest, true}},
    {"fjord.v1.Fractal.epsilon", {0, kLargest, true}},
    {"fjord.v1.Fractal.pixels", {0, 1e6, true}},
    {"fjord.v1.Fractal.viewing", {0, kLargest, true}},
    {"fjord.v1.Fractal.max_level", {0, limits::kMaxLevel, false}},
    {"fjord.v1.Material.ambient", {0, 1000, false}},
    {"fjord.v1.Material.diffuse", {0, 1000, false}},
    {"fjord.v1.Material.specular", {0, 1000, false}},
    {"fjord.v1.Material.shininess", {1, 200, false}},
    {"fjord.v1.Material.line_width", {0, 1000, true}},
};

}  // namespace

const NumberRange* RangeOf(const google::protobuf::FieldDescriptor& field) {
  static const auto* const kTable = [] {
    auto* table = new std::map<std::string_view, const NumberRange*>();
    for (const Row& row : kRows) (*table)[row.field] = &row.range;
    return table;
  }();
  const auto found = kTable->find(field.full_name());
  return found == kTable->end() ? nullptr : found->second;
}

}  // namespace fjord
