#include "engine/animation/camera_check.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/animation/fineness.h"
#include "engine/animation/stretch.h"

namespace fjord {
namespace {

constexpr size_t kMostLooks = 20'000;  // beyond those at keys

double Magnitude(double x) { return x < 0 ? -x : x; }

struct Interval {
  double low = 0;
  double high = 0;
  bool HoldsZero() const { return low <= 0 && high >= 0; }
  double Least() const { return HoldsZero() ? 0 : std::min(Magnitude(low), Magnitude(high)); }
  double Largest() const { return std::max(Magnitude(low), Magnitude(high)); }
};

Interval operator-(const Interval& a, const Interval& b) {
  return {a.low - b.high, a.high - b.low};
}

Interval operator*(const Interval& a, const Interval& b) {
  const double products[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return {*std::min_element(std::begin(products), std::end(products)),
          *std::max_element(std::begin(products), std::end(products))};
}

// Can none of the cameras within the bounds be blind?
bool AllSee(const ShotBounds& bounds) {
  Interval view[3], up[3];
  double view_size = 0, up_size = 0;
  for (int i = 0; i < 3; ++i) {
    view[i] = Interval{bounds.low.look_at[i], bounds.high.look_at[i]} -
              Interval{bounds.low.eye[i], bounds.high.eye[i]};
    up[i] = {bounds.low.up[i], bounds.high.up[i]};
    view_size += view[i].Largest();
    up_size += up[i].Largest();
  }
  // |view x up| from below against the sine that counts as seeing, with room for rounding
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Interval cross = view[j] * up[k] - view[k] * up[j];
    if (cross.Least() > 1e-8 * view_size * up_size) return true;
  }
  return false;
}

}  // namespace

std::optional<BlindFrame> FindBlindFrame(const TrackSet& camera, uint32_t frames,
                                         v1::Scene* scratch) {
  const std::vector<double> keys = camera.KeyFrames();
  std::vector<Stretch> open = CutAtKeys(keys, {1, frames}, keys.size() + 1);
  std::reverse(open.begin(), open.end());  // the first frames are looked at first
  size_t looks = kMostLooks + open.size();
  const auto at = [&](uint32_t frame) {
    camera.Apply(frame, scratch);
    return ShotNumbers(*scratch, -1);
  };
  for (; !open.empty() && looks > 0; --looks) {
    const Stretch stretch = open.back();
    open.pop_back();
    ShotBounds bounds(at(stretch.last));
    bounds.Add(at(stretch.first));
    if (AllSee(bounds)) continue;
    std::string defect = CameraState(scratch->camera()).Defect();
    if (!defect.empty()) return BlindFrame{stretch.first, std::move(defect)};
    if (stretch.first == stretch.last) continue;
    const uint32_t middle = stretch.first + (stretch.last - stretch.first) / 2;
    open.push_back({middle + 1, stretch.last});
    open.push_back({stretch.first, middle});
  }
  return std::nullopt;
}

}  // namespace fjord
