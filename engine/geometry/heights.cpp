#include "engine/geometry/heights.h"

#include <algorithm>
#include <utility>

#include "engine/base/check.h"
#include "engine/geometry/primitive_parts.h"

namespace fjord {
namespace {

using Range = HeightSource::Range;

class Flat final : public HeightSource {
 public:
  Flat(uint32_t columns, uint32_t rows) : columns_(columns), rows_(rows) {}
  uint32_t columns() const override { return columns_; }
  uint32_t rows() const override { return rows_; }
  float At(uint32_t, uint32_t) const override { return 0; }
  Range RangeOf(uint32_t, uint32_t, uint32_t, uint32_t) const override { return {}; }
  size_t Bytes() const override { return sizeof(*this); }

 private:
  uint32_t columns_;
  uint32_t rows_;
};

void Widen(Range* range, const Range& other) {
  if (other.low < range->low) range->low = other.low;
  if (other.high > range->high) range->high = other.high;
}

// Ranges of squares of samples: of 8 x 8 at level 0, of twice the side at each level above.
class Pyramid {
 public:
  static constexpr uint32_t kBase = 3;  // 8 = 1 << 3

  Pyramid(uint32_t columns, uint32_t rows, const std::vector<float>& samples) {
    Level level = Empty(columns, rows, kBase);
    for (uint32_t j = 0; j < rows; ++j) {
      for (uint32_t i = 0; i < columns; ++i) {
        const float sample = samples[size_t{j} * columns + i];
        Range& range = level.At(i >> kBase, j >> kBase);
        // the first sample of a square starts its range
        const bool first = (i & ((1u << kBase) - 1)) == 0 && (j & ((1u << kBase) - 1)) == 0;
        if (first) range = {sample, sample};
        Widen(&range, {sample, sample});
      }
    }
    levels_.push_back(std::move(level));
    while (levels_.back().columns > 1 || levels_.back().rows > 1) {
      const Level& below = levels_.back();
      Level next = Empty(below.columns, below.rows, 1);
      for (uint32_t j = 0; j < below.rows; ++j) {
        for (uint32_t i = 0; i < below.columns; ++i) {
          Range& range = next.At(i >> 1, j >> 1);
          if (((i | j) & 1) == 0) range = below.At(i, j);
          Widen(&range, below.At(i, j));
        }
      }
      levels_.push_back(std::move(next));
    }
  }

  Range Of(uint32_t i0, uint32_t j0, uint32_t i1, uint32_t j1) const {
    size_t level = 0;
    while (level + 1 < levels_.size() && std::max(i1 - i0, j1 - j0) >> (level + kBase) > 1) {
      ++level;
    }
    const Level& at = levels_[level];
    const auto shift = static_cast<uint32_t>(level) + kBase;
    Range range = at.At(i0 >> shift, j0 >> shift);
    for (uint32_t j = j0 >> shift; j <= j1 >> shift; ++j) {
      for (uint32_t i = i0 >> shift; i <= i1 >> shift; ++i) Widen(&range, at.At(i, j));
    }
    return range;
  }

  size_t Bytes() const {
    size_t bytes = 0;
    for (const Level& level : levels_) bytes += level.ranges.size() * sizeof(Range);
    return bytes;
  }

 private:
  struct Level {
    uint32_t columns = 0, rows = 0;
    std::vector<Range> ranges;

    Range& At(uint32_t i, uint32_t j) { return ranges[size_t{j} * columns + i]; }
    const Range& At(uint32_t i, uint32_t j) const { return ranges[size_t{j} * columns + i]; }
  };

  static Level Empty(uint32_t columns, uint32_t rows, uint32_t shift) {
    Level level;
    level.columns = ((columns - 1) >> shift) + 1;
    level.rows = ((rows - 1) >> shift) + 1;
    level.ranges.resize(size_t{level.columns} * level.rows);
    return level;
  }

  std::vector<Level> levels_;
};

class Sampled final : public HeightSource {
 public:
  Sampled(uint32_t columns, uint32_t rows, std::vector<float> samples)
      : columns_(columns),
        rows_(rows),
        samples_(std::move(samples)),
        pyramid_(columns, rows, samples_) {}
  uint32_t columns() const override { return columns_; }
  uint32_t rows() const override { return rows_; }
  float At(uint32_t i, uint32_t j) const override { return samples_[size_t{j} * columns_ + i]; }
  Range RangeOf(uint32_t i0, uint32_t j0, uint32_t i1, uint32_t j1) const override {
    return pyramid_.Of(i0, j0, i1, j1);
  }
  size_t Bytes() const override {
    return sizeof(*this) + samples_.size() * sizeof(float) + pyramid_.Bytes();
  }

 private:
  uint32_t columns_;
  uint32_t rows_;
  std::vector<float> samples_;
  Pyramid pyramid_;
};

}  // namespace

std::shared_ptr<const HeightSource> FlatHeights(uint32_t columns, uint32_t rows) {
  FJORD_CHECK(columns >= 2 && rows >= 2, columns, rows);
  return std::make_shared<Flat>(columns, rows);
}

std::shared_ptr<const HeightSource> SampledHeights(uint32_t columns, uint32_t rows,
                                                   std::vector<float> samples) {
  FJORD_CHECK(columns >= 2 && rows >= 2 && samples.size() == size_t{columns} * rows, columns, rows,
              samples.size());
  return std::make_shared<Sampled>(columns, rows, std::move(samples));
}

Mesh MeshOf(const HeightField& field) {
  const uint32_t columns = field.source->columns(), rows = field.source->rows();
  Mesh mesh;
  mesh.points.reserve(size_t{columns} * rows);
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) mesh.points.push_back(field.At(i, j));
  }
  const auto at = [&](uint32_t i, uint32_t j) { return j * columns + i; };
  for (uint32_t j = 0; j + 1 < rows; ++j) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      primitive::AddQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), (i + j) % 2 == 1,
                         &mesh);
    }
  }
  return mesh;
}

}  // namespace fjord
