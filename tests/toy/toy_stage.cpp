// A toy texture stage, the whole of it: it paints everything in one colour.
#include "engine/knobs/knob_row.h"
#include "tests/toy/toys.h"

namespace fjord::testing {
namespace {

struct PaintSettings {
  Rgb color{.25f, .5f, .75f};
  double share = .5;
};

const Knob kRows[] = {
    KnobRow<&PaintSettings::color>("color", "of the paint"),
    KnobRow<&PaintSettings::share>("toy_share", "more of the paint").In(0, 1),
};

class Paint final : public TextureStage {
 public:
  explicit Paint(const PaintSettings& settings) : settings_(settings) {}

  void Apply(std::span<SurfaceSample> samples, double) const override {
    for (SurfaceSample& sample : samples) {
      sample.color += (settings_.color - sample.color) * static_cast<float>(settings_.share);
    }
  }

 private:
  PaintSettings settings_;
};

}  // namespace

StageInfo ToyStage() {
  StageInfo info;
  info.name = "paint";
  info.version = 5;
  info.summary = "one colour for everything";
  info.knobs = KnobTableOf<PaintSettings>(kRows);
  info.make = [](const std::any& own) -> std::unique_ptr<TextureStage> {
    return std::make_unique<Paint>(std::any_cast<const PaintSettings&>(own));
  };
  return info;
}

}  // namespace fjord::testing
