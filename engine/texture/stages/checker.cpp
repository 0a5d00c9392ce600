// The stage "checker": squares of another colour over (u,v).
#include "engine/base/clamp.h"
#include "engine/knobs/knob_row.h"
#include "engine/texture/registry.h"

namespace fjord {
namespace {

struct CheckerSettings {
  Rgb color{.05f};
  double across = 8;
  double down = 4;
};

const Knob kRows[] = {
    KnobRow<&CheckerSettings::color>("color", "of every other square"),
    KnobRow<&CheckerSettings::across>("across", "more squares along u").In(0, 1e6),
    KnobRow<&CheckerSettings::down>("down", "more squares along v").In(0, 1e6),
};

class Checker final : public TextureStage {
 public:
  explicit Checker(const CheckerSettings& settings) : settings_(settings) {}

  void Apply(std::span<SurfaceSample> samples, double) const override {
    for (SurfaceSample& sample : samples) {
      const int64_t column = FloorToInt64(sample.u * settings_.across);
      const int64_t row = FloorToInt64(sample.v * settings_.down);
      if (((column ^ row) & 1) != 0) sample.color = settings_.color;
    }
  }

 private:
  CheckerSettings settings_;
};

}  // namespace

StageInfo CheckerStage() {
  StageInfo info;
  info.name = "checker";
  info.version = 1;
  info.summary = "squares of another colour over (u,v)";
  info.knobs = KnobTableOf<CheckerSettings>(kRows);
  info.kind = StageKind::kColor;
  info.reads = [](const std::any&) { return StageReads{.uv = true}; };
  info.make = [](const std::any& own) -> std::unique_ptr<TextureStage> {
    return std::make_unique<Checker>(std::any_cast<const CheckerSettings&>(own));
  };
  return info;
}

}  // namespace fjord
