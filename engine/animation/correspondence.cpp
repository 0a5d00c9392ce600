#include "engine/animation/correspondence.h"

#include <algorithm>
#include <numeric>

#include "engine/animation/outline.h"

namespace fjord {
namespace {

constexpr int kStartSamples = 128;    // places compared for one start
constexpr size_t kMostStarts = 1024;  // starts tried on long outlines

std::vector<uint32_t> Counting(size_t count) {
  std::vector<uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

// Twice the vector area of a closed curve.
Vec3 AreaVector(std::span<const Vec3> points) {
  Vec3 area(0);
  for (size_t i = 0; i < points.size(); ++i) {
    area += glm::cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  }
  return area;
}

std::vector<Vec3> Centred(std::vector<Vec3> points) {
  Vec3 sum(0);
  for (const Vec3& point : points) sum += point;
  const Vec3 center = sum / static_cast<double>(points.size());
  for (Vec3& point : points) point -= center;
  return points;
}

// kStartSamples places evenly round a closed curve, from `start`.
std::vector<Vec3> Sampled(std::span<const Vec3> points, std::span<const double> lengths,
                          double start) {
  std::vector<Vec3> samples;
  samples.reserve(kStartSamples);
  for (int i = 0; i < kStartSamples; ++i) {
    samples.push_back(PointAtLength(points, lengths, start + lengths.back() * i / kStartSamples));
  }
  return samples;
}

AlignedKeys AlignMeshes(const v1::Object& object, std::span<const Geometry> keys,
                        std::span<const PointPairs> pairs) {
  AlignedKeys aligned;
  const size_t count = keys[0].points.size();
  for (size_t k = 0; k < keys.size(); ++k) {
    std::vector<uint32_t> numbers = Counting(count);
    if (k > 0 && object.correspondence() == v1::BY_PAIRS) {
      for (const auto& [from, to] : pairs[k]) numbers[to] = aligned.number_of[k - 1][from];
    }
    std::vector<Vec3> points(count);
    for (size_t v = 0; v < count; ++v) points[numbers[v]] = keys[k].points[v];
    aligned.points.push_back(std::move(points));
    aligned.number_of.push_back(std::move(numbers));
  }
  return aligned;
}

}  // namespace

BestStart FindBestStart(const Geometry& from, const Geometry& to) {
  BestStart best;
  best.reversed = glm::dot(AreaVector(from.points), AreaVector(to.points)) < 0;
  std::vector<Vec3> points = to.points;
  if (best.reversed) std::reverse(points.begin(), points.end());
  const std::vector<double> from_lengths = ArcLengths(from.points, true);
  const std::vector<double> lengths = ArcLengths(points, true);
  const std::vector<Vec3> target = Centred(Sampled(from.points, from_lengths, 0));
  const size_t step = (points.size() + kMostStarts - 1) / kMostStarts;
  double least = -1;
  size_t start = 0;
  for (size_t v = 0; v < points.size(); v += step) {
    const std::vector<Vec3> samples = Centred(Sampled(points, lengths, lengths[v]));
    double sum = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
      const Vec3 apart = samples[i] - target[i];
      sum += glm::dot(apart, apart);
    }
    if (least < 0 || sum < least) {
      least = sum;
      start = v;
    }
  }
  best.vertex = static_cast<uint32_t>(best.reversed ? points.size() - 1 - start : start);
  return best;
}

AlignedKeys AlignKeys(const v1::Object& object, std::span<const Geometry> keys) {
  std::vector<PointPairs> pairs(keys.size());
  for (size_t k = 1; k < keys.size() && object.correspondence() == v1::BY_PAIRS; ++k) {
    for (const v1::Pair& pair : object.key(static_cast<int>(k)).pair()) {
      pairs[k].emplace_back(pair.from() - 1, pair.to() - 1);
    }
  }
  if (!keys[0].curve) return AlignMeshes(object, keys, pairs);
  if (object.correspondence() == v1::BY_INDEX) {
    AlignedKeys aligned;
    for (const Geometry& key : keys) {
      aligned.points.push_back(key.points);
      aligned.number_of.push_back(Counting(key.points.size()));
    }
    return aligned;
  }
  if (object.correspondence() == v1::BY_PAIRS || !keys[0].closed) return AlignOutlines(keys, pairs);

  // computed: turn every outline the way of the first, then anchor its best start
  std::vector<Geometry> turned(keys.begin(), keys.end());
  std::vector<bool> reversed(keys.size(), false);
  for (size_t k = 1; k < keys.size(); ++k) {
    const BestStart start = FindBestStart(turned[k - 1], keys[k]);
    reversed[k] = start.reversed;
    const auto last = static_cast<uint32_t>(keys[k].points.size() - 1);
    if (start.reversed) std::reverse(turned[k].points.begin(), turned[k].points.end());
    pairs[k] = {{0, start.reversed ? last - start.vertex : start.vertex}};
  }
  AlignedKeys aligned = AlignOutlines(turned, pairs);
  for (size_t k = 1; k < keys.size(); ++k) {
    if (reversed[k]) std::reverse(aligned.number_of[k].begin(), aligned.number_of[k].end());
  }
  return aligned;
}

}  // namespace fjord
