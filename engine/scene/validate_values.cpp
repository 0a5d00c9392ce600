// CheckCounts and CheckValues of validate.h.
#include <google/protobuf/descriptor.h>

#include "engine/scene/entry_kinds.h"
#include "engine/scene/limits.h"
#include "engine/scene/ranges.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// Takes the place of a number that is refused: within every range of ranges.cpp.
constexpr uint32_t kStandIn = 1;

class ValueChecker {
 public:
  explicit ValueChecker(SceneErrors* errors) : errors_(errors) {}

  // `around`: the range of the Vec3 field that this message is the value of, or null.
  void Check(Message* message, const NumberRange* around) {
    const Reflection& reflection = *message->GetReflection();
    std::vector<const FieldDescriptor*> fields;
    reflection.ListFields(*message, &fields);
    const bool entry = KindOf(message->GetDescriptor()) != nullptr;
    for (const FieldDescriptor* field : fields) {
      if (entry && field->name() == "parameter")
        continue;  // its table's matter: validate_entries.cpp
      const int count = field->is_repeated() ? reflection.FieldSize(*message, field) : 1;
      for (int i = 0; i < count && !errors_->Full(); ++i) {
        route_.steps.push_back({field, field->is_repeated() ? i : -1});
        CheckField(message, reflection, *field, field->is_repeated() ? i : -1, around);
        route_.steps.pop_back();
      }
    }
  }

 private:
  void CheckField(Message* message, const Reflection& reflection, const FieldDescriptor& field,
                  int index, const NumberRange* around) {
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE: {
        const double value = index < 0 ? reflection.GetDouble(*message, &field)
                                       : reflection.GetRepeatedDouble(*message, &field, index);
        if (IsSound(value, around != nullptr ? around : RangeOf(field))) return;
        if (index < 0) reflection.SetDouble(message, &field, kStandIn);
        if (index >= 0) reflection.SetRepeatedDouble(message, &field, index, kStandIn);
        return;
      }
      case FieldDescriptor::CPPTYPE_UINT32:
        if (index >= 0) return;
        if (!IsSound(reflection.GetUInt32(*message, &field), RangeOf(field)))
          reflection.SetUInt32(message, &field, kStandIn);
        return;
      case FieldDescriptor::CPPTYPE_ENUM: {
        if (index >= 0) return;
        const int value = reflection.GetEnumValue(*message, &field);
        if (field.enum_type()->FindValueByNumber(value) != nullptr) return;
        errors_->Refuse(route_, "there is no choice number " + std::to_string(value));
        reflection.ClearField(message, &field);
        return;
      }
      case FieldDescriptor::CPPTYPE_STRING: {
        std::string scratch;
        const std::string& text = reflection.GetStringReference(*message, &field, &scratch);
        if (!IsPrintable(text)) errors_->Refuse(route_, "the text is not printable UTF-8");
        return;
      }
      case FieldDescriptor::CPPTYPE_MESSAGE:
        Check(index < 0 ? reflection.MutableMessage(message, &field)
                        : reflection.MutableRepeatedMessage(message, &field, index),
              RangeOf(field));
        return;
      default:
        return;
    }
  }

  bool IsSound(double value, const NumberRange* range) {
    if (!(value - value == 0)) {
      errors_->Refuse(route_, "not a finite number");
    } else if (value > limits::kLargest || value < -limits::kLargest) {
      errors_->Refuse(route_, NumberText(value) + " cannot be meant; numbers are at most " +
                                  NumberText(limits::kLargest));
    } else if (range != nullptr && !range->Holds(value)) {
      errors_->Refuse(route_, NumberText(value) + " is out of range: " + range->ToString());
    } else {
      return true;
    }
    return false;
  }

  SceneErrors* errors_;
  Route route_;
};

uint64_t PointsIn(const v1::Shape& shape) {
  if (shape.has_mesh()) {
    uint64_t corners = 0;
    for (const v1::Face& face : shape.mesh().face())
      corners += static_cast<uint64_t>(face.v_size());
    return std::max<uint64_t>(static_cast<uint64_t>(shape.mesh().point_size()), corners / 6);
  }
  return shape.has_polyline() ? static_cast<uint64_t>(shape.polyline().point_size()) : 0;
}

}  // namespace

bool IsPrintable(const std::string& text) {
  int follow = 0;  // bytes of the character still to come
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (follow > 0) {
      if ((byte & 0xc0) != 0x80) return false;
      --follow;
    } else if (byte < 0x20 || byte == 0x7f || (byte >= 0x80 && byte < 0xc2) || byte > 0xf4) {
      return false;
    } else if (byte >= 0x80) {
      follow = byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
    }
  }
  return follow == 0;
}

bool CheckCounts(const v1::Scene& scene, SceneErrors* errors) {
  bool within = true;
  const auto check = [&](uint64_t count, uint64_t most, const Route& route,
                         const std::string& what) {
    if (count <= most) return;
    errors->Add(route, std::to_string(count) + " " + what + "; at most " + std::to_string(most),
                ErrorCode::kLimit);
    within = false;
  };
  const auto size = [](int n) { return static_cast<uint64_t>(n); };
  check(size(scene.objects_size()), limits::kObjects, Route().Then("objects"), "objects");
  uint64_t placements = 0;
  for (const v1::Object& object : scene.objects()) placements += size(object.placements_size());
  check(placements, limits::kPlacements, Route().Then("objects"), "placements");
  check(size(scene.lights_size()), limits::kLights, Route().Then("lights"), "lights");
  check(size(scene.track_size()), limits::kTracks, Route().Then("track"), "tracks");
  uint64_t keys = 0, points = 0, track_keys = 0;
  for (int i = 0; i < scene.objects_size(); ++i) {
    const v1::Object& object = scene.objects(i);
    const Route route = Route().Then("objects", i);
    keys += size(object.key_size());
    points += PointsIn(object.shape());
    for (const v1::Key& key : object.key()) points += PointsIn(key.shape());
    check(size(object.material().ramp_size()), limits::kRampStops, route.Then("material"),
          "ramp stops");
    check(size(object.path().control_size()), limits::kControlPoints, route.Then("path"),
          "control points");
    for (int p = 0; p < object.point_path_size(); ++p) {
      check(size(object.point_path(p).path().control_size()), limits::kControlPoints,
            route.Then("point_path", p), "control points");
    }
  }
  for (const v1::Track& track : scene.track()) track_keys += size(track.key_size());
  check(keys, limits::kKeys, {}, "key pictures");
  check(track_keys, limits::kKeys, {}, "track keys");
  check(points, limits::kInlinePoints, {}, "points written in the scene; keep big shapes in files");
  return within;
}

void CheckValues(v1::Scene* scene, SceneErrors* errors) {
  ValueChecker(errors).Check(scene, nullptr);
}

}  // namespace fjord
