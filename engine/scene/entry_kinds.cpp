#include "engine/scene/entry_kinds.h"

#include <algorithm>

#include "engine/fractal/registry.h"
#include "engine/texture/registry.h"
#include "fjord/v1/frame.pb.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

template <typename Info>
std::vector<const EntryInfo*> Pointers(std::span<const Info> entries) {
  std::vector<const EntryInfo*> pointers;
  for (const Info& entry : entries) pointers.push_back(&entry);
  return pointers;
}

}  // namespace

std::span<const EntryKind> EntryKinds() {
  static const EntryKind kKinds[] = {
      {"fractal", "method", "objects.fractal", v1::Fractal::descriptor(),
       v1::FrameFractal::descriptor(), "method", [] { return Pointers(FractalMethods()); }},
      {"texture", "stage", "objects.material.stage", v1::Stage::descriptor(),
       v1::FrameStage::descriptor(), "kind", [] { return Pointers(TextureStages()); }},
  };
  return kKinds;
}

const EntryKind* KindOf(const google::protobuf::Descriptor* type) {
  for (const EntryKind& kind : EntryKinds()) {
    if (kind.scene_message == type || kind.frame_message == type) return &kind;
  }
  return nullptr;
}

const EntryInfo* EntryKind::Find(std::string_view entry) const {
  for (const EntryInfo* info : entries()) {
    if (info->name == entry) return info;
  }
  return nullptr;
}

const Knob* EntryKind::AnyKnob(std::string_view knob) const {
  for (const EntryInfo* info : entries()) {
    if (const Knob* found = info->knobs.Find(knob); found != nullptr) return found;
  }
  return nullptr;
}

std::vector<std::string> EntryKind::FieldNames() const {
  std::vector<std::string> names;
  for (int i = 0; i < scene_message->field_count(); ++i) {
    if (scene_message->field(i)->name() != "parameter")
      names.push_back(scene_message->field(i)->name());
  }
  for (const EntryInfo* info : entries()) {
    for (const Knob& knob : info->knobs.rows()) {
      if (std::find(names.begin(), names.end(), knob.name) == names.end())
        names.emplace_back(knob.name);
    }
  }
  return names;
}

}  // namespace fjord
