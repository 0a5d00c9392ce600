// The stage "noise": a solid noise in the rest pose mixes in another colour.
#include <algorithm>

#include "engine/knobs/knob_row.h"
#include "engine/texture/registry.h"
#include "engine/texture/value_noise.h"

namespace fjord {
namespace {

struct NoiseSettings {
  Rgb color{.05f};
  double width = .25;
  uint32_t octaves = 4;
  double gain = .5;
  double contrast = 1.5;
  double amount = 1;
  uint64_t seed = 1;
  Vec3 drift{0};
};

const Knob kRows[] = {
    KnobRow<&NoiseSettings::color>("color", "what is mixed in"),
    KnobRow<&NoiseSettings::width>("width", "larger patches").Above(0).Unit("scene units"),
    KnobRow<&NoiseSettings::octaves>("octaves", "finer detail").In(1, 16),
    KnobRow<&NoiseSettings::gain>("gain", "stronger detail").In(0, 1),
    KnobRow<&NoiseSettings::contrast>("contrast", "sharper edges between the colours").In(0, 1000),
    KnobRow<&NoiseSettings::amount>("amount", "more of the colour").In(0, 1),
    KnobRow<&NoiseSettings::seed>("seed", "another pattern").Fixed(),
    KnobRow<&NoiseSettings::drift>("drift",
                                   "the pattern moves through the object, in units a frame"),
};

bool Drifts(const NoiseSettings& settings) { return settings.drift != Vec3(0); }

class Noise final : public TextureStage {
 public:
  explicit Noise(const NoiseSettings& settings) : settings_(settings) {}

  void Apply(std::span<SurfaceSample> samples, double time) const override {
    const Vec3 moved = settings_.drift * (Drifts(settings_) ? time : 0);
    const double scale = 1 / settings_.width;
    for (SurfaceSample& sample : samples) {
      const double noise = NoiseSum((sample.rest - moved) * scale, settings_.seed,
                                    settings_.octaves, settings_.gain);
      const double share = std::clamp(.5 + .5 * settings_.contrast * noise, 0., 1.);
      const auto mix = static_cast<float>(share * settings_.amount);
      sample.color = sample.color + (settings_.color - sample.color) * mix;
    }
  }

 private:
  NoiseSettings settings_;
};

}  // namespace

StageInfo NoiseStage() {
  StageInfo info;
  info.name = "noise";
  info.version = 1;
  info.summary = "a solid noise mixes in another colour";
  info.knobs = KnobTableOf<NoiseSettings>(kRows);
  info.kind = StageKind::kColor;
  info.reads = [](const std::any& own) {
    return StageReads{.rest = true, .time = Drifts(std::any_cast<const NoiseSettings&>(own))};
  };
  info.make = [](const std::any& own) -> std::unique_ptr<TextureStage> {
    return std::make_unique<Noise>(std::any_cast<const NoiseSettings&>(own));
  };
  return info;
}

}  // namespace fjord
