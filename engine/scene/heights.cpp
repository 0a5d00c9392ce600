#include "engine/scene/heights.h"

#include <cstring>
#include <utility>

#include "engine/image/codec.h"
#include "engine/image/half.h"

namespace fjord {
namespace {

constexpr float kMost = 1e6f;  // of a sample; size.z makes it a height

Error BadSample(uint32_t column, uint32_t row, float sample) {
  return Invalid("the sample in column " + std::to_string(column + 1) + ", row " +
                 std::to_string(row + 1) + " is " + std::to_string(sample) +
                 "; heights are finite and at most 1e6 either way, and size.z scales them");
}

// The sample number `at` of the picture.
float SampleOf(const Picture& picture, size_t at) {
  const uint8_t* bytes = picture.bytes.data() + at * BytesPerSample(picture.format);
  switch (picture.format) {
    case PixelFormat::kPng8:
      return static_cast<float>(*bytes) / 255.f;
    case PixelFormat::kPng16:
    case PixelFormat::kExrHalf: {
      uint16_t word = 0;
      std::memcpy(&word, bytes, sizeof word);
      return picture.format == PixelFormat::kPng16 ? static_cast<float>(word) / 65535.f
                                                   : HalfToFloat(word);
    }
    default: {
      float value = 0;
      std::memcpy(&value, bytes, sizeof value);
      return value;
    }
  }
}

Result<HeightField> FromPicture(const v1::Heights& heights, const std::string& bytes) {
  const v1::File& file = heights.file();
  const Result<Picture> picture =
      DecodePicture(bytes, file.path().empty() ? file.digest() : file.path());
  if (!picture) return picture.error();
  if (picture->width < 2 || picture->height < 2) {
    return Invalid(file.path() + " has " + std::to_string(picture->width) + "x" +
                   std::to_string(picture->height) + " samples; heights need 2x2 or more");
  }
  std::vector<float> samples(size_t{picture->width} * picture->height);
  for (uint32_t y = 0; y < picture->height; ++y) {
    const uint32_t row = picture->height - 1 - y;
    for (uint32_t x = 0; x < picture->width; ++x) {
      const float sample =
          SampleOf(*picture, picture->channels() * (size_t{y} * picture->width + x));
      if (!(sample >= -kMost && sample <= kMost)) return BadSample(x, y, sample);
      samples[size_t{row} * picture->width + x] = sample;
    }
  }
  return HeightField{SampledHeights(picture->width, picture->height, std::move(samples)), Vec3(1)};
}

Result<HeightField> FromSamples(const v1::Heights& heights) {
  const uint64_t columns = heights.columns(), count = static_cast<uint64_t>(heights.z_size());
  if (columns < 2 || count % columns != 0 || count / columns < 2) {
    return Invalid("z has " + std::to_string(count) + " samples in columns: " +
                   std::to_string(columns) + "; give whole rows, two or more, of two or more");
  }
  std::vector<float> samples;
  samples.reserve(count);
  for (const double z : heights.z()) {
    const auto sample = static_cast<float>(z);
    if (!(sample >= -kMost && sample <= kMost)) {
      const uint64_t at = samples.size();
      return BadSample(static_cast<uint32_t>(at % columns), static_cast<uint32_t>(at / columns),
                       sample);
    }
    samples.push_back(sample);
  }
  return HeightField{SampledHeights(static_cast<uint32_t>(columns),
                                    static_cast<uint32_t>(count / columns), std::move(samples)),
                     Vec3(1)};
}

}  // namespace

Result<HeightField> DecodeHeights(const v1::Heights& heights,
                                  const std::map<std::string, std::string>& assets) {
  if (heights.has_file() && heights.z_size() > 0) return Invalid("give file or z, not both");
  if (heights.has_pixels() && heights.has_epsilon()) {
    return Invalid("give pixels or epsilon, not both");
  }
  Result<HeightField> field = Invalid("");
  if (heights.has_file()) {
    const auto found = assets.find(heights.file().digest());
    if (found == assets.end()) return Invalid("file " + heights.file().path() + " was not read");
    field = FromPicture(heights, found->second);
  } else {
    field = FromSamples(heights);
  }
  if (!field) return field.error();
  field->size = Vec3(heights.size().x(), heights.size().y(), heights.size().z());
  if (!(field->size.x > 0 && field->size.y > 0)) {
    return Invalid("the size of heights must be greater than 0 along x and y");
  }
  return field;
}

}  // namespace fjord
