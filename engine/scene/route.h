// A route: the way from a Scene message down to one of its fields, by reflection. Tracks and --set
// write through routes; defects carry one, and places in the user's text are found by it.
//
// A route is a plain value that stays right as long as lists keep their order. Thread-safe to
// share.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/knobs/knob.h"
#include "engine/scene/field_path.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// A knob of a registry's entry takes one step from the entry's message to the values of its
// Parameter; a single number of a vector takes a second step with the number's index.
struct RouteStep {
  const google::protobuf::FieldDescriptor* field = nullptr;
  int index = -1;              // from 0; -1: not a list, or the whole of it
  const Knob* knob = nullptr;  // of any entry that has one of this name; null: a plain field
  friend bool operator==(const RouteStep&, const RouteStep&) = default;
};

struct Route {
  std::vector<RouteStep> steps;

  // One step further; the field or knob must exist.
  Route Then(std::string_view field, int index = -1) const;
  // To a knob that the entry's kind may not have; then this route itself.
  Route ThenKnob(std::string_view knob) const;
  bool empty() const { return steps.empty(); }
  // Is `other` this route, or inside it?
  bool Holds(const Route& other) const;
  friend bool operator==(const Route&, const Route&) = default;
};

// The step from an entry's message to a knob that any entry of its kind has; `field` null where
// none has it.
RouteStep KnobStep(const google::protobuf::Descriptor* type, std::string_view name);

// As a user would write it: entries by name where they have one, else by number.
std::string PrintRoute(const v1::Scene& scene, const Route& route);

// What a path means in `scene`. Errors name the piece that is wrong and the nearest names. A list
// without [ ] is an error, and so is a way through a member of `shape` that is not the one in use.
Result<Route> FindRoute(const v1::Scene& scene, const FieldPath& path);

// The message that holds the route's last field, made on the way where it was absent; of a knob its
// Parameter.
google::protobuf::Message* OpenParent(v1::Scene* scene, const Route& route);
// The same for reading; null where a message on the way is absent.
const google::protobuf::Message* FindParent(const v1::Scene& scene, const Route& route);

// How many numbers a track of this field has: 1 for a double, 3 for Vec3 and Color, else 0; of a
// knob what it says itself.
int NumberCount(const RouteStep& step);
void SetNumbers(v1::Scene* scene, const Route& route, std::span<const double> values);

// --set: a number, true or false, an enumerator, a text, "x y z" for vectors and colours, or the
// text form of a message.
Result<> SetFromText(v1::Scene* scene, const Route& route, std::string_view value);

}  // namespace fjord
