#include "engine/asset/asset.h"

#include <bit>
#include <string>
#include <utility>

namespace fjord {
namespace {

// Digests numbers as they come, high byte first.
class SampleDigest {
 public:
  explicit SampleDigest(const std::string& head) { sha_.Update(head); }

  void Add(double value) { Put<8>(value == 0 ? 0 : std::bit_cast<uint64_t>(value)); }
  void Add(uint32_t value) { Put<4>(value); }
  Digest Finish() {
    sha_.Update({buffer_.data(), used_});
    return sha_.Finish();
  }

 private:
  template <size_t kBytes>
  void Put(uint64_t value) {
    if (used_ + kBytes > buffer_.size()) {
      sha_.Update({buffer_.data(), used_});
      used_ = 0;
    }
    for (size_t i = 0; i < kBytes; ++i) {
      buffer_[used_++] = static_cast<uint8_t>(value >> (8 * (kBytes - 1 - i)));
    }
  }

  Sha256 sha_;
  std::vector<uint8_t> buffer_ = std::vector<uint8_t>(size_t{1} << 16);
  size_t used_ = 0;
};

std::string Head(const char* kind, uint64_t count) {
  return std::string("fjord-asset 1 ") + kind + " " + std::to_string(count);
}

Digest DigestOf(const PointList& points) {
  SampleDigest digest(Head("points", points.size()) + "\n");
  for (const Vec3& point : points) {
    for (int i = 0; i < 3; ++i) digest.Add(point[i]);
  }
  return digest.Finish();
}

Digest DigestOf(const ColorList& colors) {
  SampleDigest digest(Head("colors", colors.size()) + "\n");
  for (const Rgb& color : colors) {
    for (int i = 0; i < 3; ++i) digest.Add(double{color[i]});
  }
  return digest.Finish();
}

Digest DigestOf(const FaceList& faces) {
  SampleDigest digest(Head("faces", faces.size.size()) + " " + std::to_string(faces.vertex.size()) +
                      "\n");
  for (const uint32_t size : faces.size) digest.Add(size);
  for (const uint32_t vertex : faces.vertex) digest.Add(vertex);
  return digest.Finish();
}

Digest DigestOf(const HeightSamples& heights) {
  SampleDigest digest(Head("heights", heights->columns()) + " " + std::to_string(heights->rows()) +
                      "\n");
  for (uint32_t j = 0; j < heights->rows(); ++j) {
    for (uint32_t i = 0; i < heights->columns(); ++i) {
      const float sample = heights->At(i, j);
      digest.Add(sample == 0 ? 0 : std::bit_cast<uint32_t>(sample));
    }
  }
  return digest.Finish();
}

Digest DigestOf(const PlacementList& placements) {
  SampleDigest digest(Head("placements", placements.size()) + "\n");
  for (const Rows& rows : placements) {
    for (const double number : rows) digest.Add(number);
  }
  return digest.Finish();
}

uint64_t NumbersOf(const HeightSamples& heights) {
  return uint64_t{heights->columns()} * heights->rows();
}
uint64_t NumbersOf(const PlacementList& placements) { return 12 * placements.size(); }
uint64_t NumbersOf(const PointList& points) { return 3 * points.size(); }
uint64_t NumbersOf(const ColorList& colors) { return 3 * colors.size(); }
uint64_t NumbersOf(const FaceList& faces) { return faces.size.size() + faces.vertex.size(); }

}  // namespace

SharedAsset MakeAsset(AssetData data) {
  auto asset = std::make_shared<Asset>();
  asset->digest = std::visit([](const auto& list) { return DigestOf(list); }, data);
  asset->numbers = std::visit([](const auto& list) { return NumbersOf(list); }, data);
  asset->data = std::move(data);
  return asset;
}

void AssetSet::Add(SharedAsset asset) {
  const Digest digest = asset->digest;
  assets_.emplace(digest, std::move(asset));
}

Result<SharedAsset> AssetSet::Find(const Digest& digest) const {
  const auto found = assets_.find(digest);
  if (found != assets_.end()) return found->second;
  return MakeError(ErrorCode::kNotFound,
                   "frame scene: the list with digest " + digest.Hex() + " is not at hand");
}

}  // namespace fjord
