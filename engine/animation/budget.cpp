// HoldAgainstBudget of estimate.h: what to say to a frame that asks for too much.
#include <charconv>

#include "engine/animation/estimate.h"
#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/scene/ranges.h"

namespace fjord {
namespace {

constexpr int kHalvings = 40;
constexpr double kMostCoarser = 1e40;

double CountOf(const ObjectEstimate& estimate, Counted counted) {
  return counted == Counted::kInView ? estimate.in_view : estimate.leaves;
}

struct Knob {
  std::string name;
  double value = 0;
  bool finer_is_more = false;  // as `viewing`
};

Knob KnobOf(const v1::Fractal& fractal) {
  if (fractal.has_epsilon()) return {"epsilon", fractal.epsilon(), false};
  if (fractal.has_viewing()) return {"viewing", fractal.viewing(), true};
  return {"pixels", fractal.pixels(), false};
}

// Two digits, away from `value` upwards or downwards.
double Rounded(double value, bool up) {
  double unit = 1;
  while (value / unit >= 100) unit *= 10;
  while (value / unit < 10) unit *= .1;
  const double digits = value / unit;
  const int64_t whole = up ? -FloorToInt64(-digits) : FloorToInt64(digits);
  return static_cast<double>(whole) * unit;
}

std::string Digits(double value, int digits) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  std::string text(buffer, end);
  if (const size_t plus = text.find("e+"); plus != std::string::npos) text.erase(plus + 1, 1);
  return text;
}

}  // namespace

std::string LeavesText(double leaves) { return Digits(leaves, leaves < 1e6 ? 6 : 2); }

Result<> HoldAgainstBudget(const v1::FrameScene& frame, const AssetResolver* assets,
                           const v1::Scene& scene, double budget, Counted counted,
                           const std::string& lift, OverBudget* over) {
  const Result<FrameEstimate> estimate = EstimateFrame(frame, assets);
  if (!estimate) return estimate.error();
  const double total = CountOf(estimate->all, counted);
  if (total <= budget) return {};
  for (size_t i = 0; i < estimate->objects.size(); ++i) {
    const auto largest = static_cast<size_t>(over->object);
    if (CountOf(estimate->objects[i], counted) > CountOf(estimate->objects[largest], counted)) {
      over->object = static_cast<int>(i);
    }
  }
  const v1::Object& object = scene.objects(over->object);
  const double own = CountOf(estimate->objects[static_cast<size_t>(over->object)], counted);
  const std::string what = frame.object(over->object).curve() ? " segments" : " triangles";
  const std::string limit = " in a frame; the budget is " + LeavesText(budget);
  if (!object.has_fractal()) {
    over->message = "its shape alone has " + LeavesText(own) + what + limit + "; " + lift;
    return {};
  }
  const Knob knob = KnobOf(object.fractal());
  over->knob = knob.name;
  over->message = knob.name + " " + Digits(knob.value, 6) + " would make about " + LeavesText(own) +
                  what + limit;
  const double others = total - own;
  // The least factor that fits, by halving its logarithm.
  const auto fits = [&](double coarser) {
    const Result<ObjectEstimate> coarse = EstimateObject(frame, assets, over->object, coarser);
    return coarse && others + CountOf(*coarse, counted) <= budget;
  };
  if (fits(kMostCoarser)) {
    double low = 0, high = exact::Log2(kMostCoarser);
    for (int i = 0; i < kHalvings && high - low > 1e-3; ++i) {
      const double middle = .5 * (low + high);
      (fits(exact::Exp2(middle)) ? high : low) = middle;
    }
    const double coarser = exact::Exp2(high);
    const double value = knob.finer_is_more ? knob.value / coarser : knob.value * coarser;
    over->message += "; " + Digits(Rounded(value, !knob.finer_is_more), 2) + " would fit";
  } else {
    over->message += ", and the other objects about " + LeavesText(others);
  }
  over->message += "; " + lift;
  return {};
}

}  // namespace fjord
