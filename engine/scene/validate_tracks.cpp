// CheckTracks of validate.h.
#include <google/protobuf/descriptor.h>

#include <map>

#include "engine/scene/parameters.h"
#include "engine/scene/ranges.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;

// Why a number cannot change within a shot; empty where it can.
std::string WhyFixed(const v1::Scene& scene, const Route& route) {
  const auto& steps = route.steps;
  const std::string& top = steps[0].field->name();
  if (top == "output") return "it belongs to the whole shot";
  if (top == "track") return "a track cannot change a track";
  if (top != "objects" || steps.size() < 2) return "";
  const std::string& part = steps[1].field->name();
  if (part == "key") return "a key picture stands at one frame; add a key instead";
  if (part == "placements") return "placements stand still; move the object's own transform";
  if (part == "shape" && scene.objects(steps[0].index).key_size() > 0)
    return "the shape comes from keys";
  if (part == "shape" && steps.size() > 3 && steps[2].field->name() == "heights" &&
      steps[3].field->name() != "size") {
    return "of heights only the size can change";
  }
  if (part == "shape" && steps.size() > 3 && steps[2].field->name() == "file") {
    return "it decides which points there are";
  }
  return "";
}

// Whole numbers and texts: what they are for decides what to tell.
std::string WhyNotNumber(const Route& route) {
  const FieldDescriptor& field = *route.steps.back().field;
  const Knob* knob = route.steps.back().knob;
  const std::string name = knob != nullptr ? std::string(knob->name) : field.name();
  if (knob != nullptr || field.containing_type() == v1::Fractal::descriptor()) {
    return name + " shapes the whole shot; it cannot change over time";
  }
  if (name == "rest_frame" || name == "segments" || name == "rings") {
    return name + " decides which points there are; it cannot change over time";
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    return name + " is not a number; go on to one of its fields, as in " + name + "." +
           field.message_type()->field(0)->name();
  }
  return "only numbers, vectors and colours change over time; " + name + " is none";
}

// Messages whose absence means something: a track does not bring them in.
std::string MissingOwner(const v1::Scene& scene, const Route& route) {
  const auto& steps = route.steps;
  if (steps[0].field->name() == "sea" && !scene.has_sea())
    return "the scene has no sea; add sea {}";
  if (steps[0].field->name() != "objects" || steps.size() < 2) return "";
  const v1::Object& object = scene.objects(steps[0].index);
  if (steps[1].field->name() == "fractal" && !object.has_fractal()) {
    return "the object has no fractal; add fractal {}";
  }
  if (steps[1].field->name() == "shape" && FindParent(scene, route) == nullptr) {
    return "the shape has no such part";
  }
  return "";
}

const google::protobuf::Descriptor* EntryType(const Route& route) {
  size_t at = route.steps.size();
  while (route.steps[at - 1].knob != nullptr) --at;
  return route.steps[at - 1].field->message_type();
}

// The entry that the knob at the route's end belongs to; its info null where there is none of that
// name.
struct OwnerOfKnob {
  const EntryInfo* info = nullptr;
  std::any settings;
};

OwnerOfKnob FindOwner(const v1::Scene& scene, const Route& route) {
  Route entry = route;
  while (entry.steps.back().knob != nullptr) entry.steps.pop_back();
  const EntryKind& kind = *KindOf(EntryType(route));
  entry.steps.push_back({EntryType(route)->field(0), -1});  // any field of it
  const google::protobuf::Message* message = FindParent(scene, entry);
  OwnerOfKnob owner;
  if (message == nullptr) return owner;
  owner.info = kind.Find(EntryName(kind, *message));
  if (owner.info == nullptr) return owner;
  std::vector<KnobDefect> defects;
  owner.settings =
      owner.info->knobs.Read(ValuesOf(ParametersOf(*message)), owner.info->name, &defects);
  return owner;
}

class TrackChecker {
 public:
  TrackChecker(v1::Scene* scene, SceneErrors* errors) : scene_(scene), errors_(errors) {}

  void Check(int index) {
    const v1::Track& track = scene_->track(index);
    const Route here = Route().Then("track", index);
    if (track.path().empty()) {
      errors_->Add(here, "path is missing; say which number changes, as in \"camera.eye\"");
      return;
    }
    Result<Route> target = Target(track.path());
    if (!target) {
      errors_->Add(here.Then("path"), target.error().message);
      return;
    }
    const int count = NumberCount(target->steps.back());
    if (const std::string why = WhyFixed(*scene_, *target); !why.empty()) {
      errors_->Add(here.Then("path"), track.path() + " cannot have a track: " + why);
    } else if (count == 0) {
      errors_->Add(here.Then("path"),
                   track.path() + " cannot have a track: " + WhyNotNumber(*target));
    } else if (const std::string missing = MissingOwner(*scene_, *target); !missing.empty()) {
      errors_->Add(here.Then("path"), track.path() + ": " + missing);
    } else {
      if (!CheckKnob(track.path(), *target, here)) return;
      CheckTrackKeys(track, here, *target, count);
      CheckAlone(track.path(), *target, here);
      OpenParent(scene_, *target);
    }
  }

 private:
  Result<Route> Target(const std::string& text) const {
    Result<FieldPath> path = ParseFieldPath(text);
    if (!path) return path.error();
    return FindRoute(*scene_, *path);
  }

  // The entry's own knob of that name decides; false where it cannot have a track.
  bool CheckKnob(const std::string& path, const Route& target, const Route& here) {
    knob_ = target.steps.back().knob;
    if (knob_ == nullptr) return true;
    owner_ = FindOwner(*scene_, target);
    const OwnerOfKnob& owner = owner_;
    if (owner.info == nullptr) {
      knob_ = nullptr;
      return true;
    }
    knob_ = owner.info->knobs.Find(knob_->name);
    if (knob_ == nullptr) {
      const EntryKind& kind = *KindOf(EntryType(target));
      errors_->Add(here.Then("path"), path + ": " + std::string(kind.noun) + " " +
                                          std::string(owner.info->name) + " has no such knob");
      return false;
    }
    if (!knob_->Works(owner.settings)) {
      errors_->Add(here.Then("path"), path + " " + IdleText(*knob_));
      return false;
    }
    return true;
  }

  void CheckTrackKeys(const v1::Track& track, const Route& here, const Route& target, int count) {
    if (track.key_size() == 0) errors_->Add(here, "the track has no keys");
    for (int k = 0; k < track.key_size() && !errors_->Full(); ++k) {
      const v1::TrackKey& key = track.key(k);
      const Route key_route = here.Then("key", k);
      if (!key.has_frame()) {
        errors_->Add(key_route, "frame is missing");
      } else if (k > 0 && key.frame() <= track.key(k - 1).frame() &&
                 !errors_->Refused(here.Then("key", k - 1).Then("frame"))) {
        errors_->Add(key_route.Then("frame"),
                     "frame " + NumberText(key.frame()) + " comes after frame " +
                         NumberText(track.key(k - 1).frame()) + "; keys ascend, one at a frame");
      }
      if (key.value_size() != count) {
        errors_->Add(key_route, track.path() + " has " + std::to_string(count) +
                                    (count == 1 ? " number" : " numbers") + "; this key gives " +
                                    std::to_string(key.value_size()));
        continue;
      }
      for (int i = 0; i < count; ++i) CheckRange(key.value(i), target, key_route.Then("value", i));
    }
  }

  // The row's range, and the entry's rules with this value beside the others.
  void CheckKnobValue(double value, const Route& target, const Route& place) {
    if (knob_ == nullptr) return;
    if (!knob_->range.Holds(value)) {
      errors_->Add(place, NumberText(value) + " is out of range: " + knob_->range.ToString());
      return;
    }
    if (NumberCount(target.steps.back()) != 1 || target.steps.back().index >= 0) return;
    std::any settings = owner_.settings;
    knob_->Set(settings, {.numbers = {value}});
    for (const KnobDefect& defect : owner_.info->knobs.Check(settings, owner_.info->name)) {
      if (defect.knob == knob_->name) errors_->Add(place, defect.message);
    }
  }

  // Easing never leaves the two keys' values, so what holds at the keys holds between.
  void CheckRange(double value, const Route& target, const Route& place) {
    const FieldDescriptor& field = *target.steps.back().field;
    if (target.steps.back().knob != nullptr) {
      CheckKnobValue(value, target, place);
      return;
    }
    const NumberRange* range = RangeOf(field);
    if (range == nullptr && field.message_type() == v1::Color::descriptor()) {
      range = RangeOf(*v1::Color::descriptor()->FindFieldByName("r"));
    }
    if (range == nullptr && target.steps.size() > 1)
      range = RangeOf(*target.steps[target.steps.size() - 2].field);
    if (range != nullptr && !range->Holds(value)) {
      errors_->Add(place, NumberText(value) + " is out of range: " + range->ToString());
    }
  }

  void CheckAlone(const std::string& path, const Route& target, const Route& here) {
    // by the head of the route, so that many tracks are compared with few
    auto& others = seen_[PrintRoute(*scene_, {{target.steps.begin(), target.steps.begin() + 1}})];
    for (const auto& [other, other_path] : others) {
      if (!other.Holds(target) && !target.Holds(other)) continue;
      std::string message = path;
      if (path == other_path) {
        message += " has a track already";
      } else {
        message.append(" and ").append(other_path).append(" are tracks of the same number");
      }
      errors_->Add(here.Then("path"), message);
      return;
    }
    others.emplace_back(target, path);
  }

  v1::Scene* scene_;
  SceneErrors* errors_;
  OwnerOfKnob owner_;
  const Knob* knob_ = nullptr;  // what the track at hand changes; null: a plain field
  std::map<std::string, std::vector<std::pair<Route, std::string>>> seen_;
};

}  // namespace

void CheckTracks(v1::Scene* scene, SceneErrors* errors) {
  TrackChecker checker(scene, errors);
  for (int i = 0; i < scene->track_size() && !errors->Full(); ++i) checker.Check(i);
}

}  // namespace fjord
