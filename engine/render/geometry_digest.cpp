#include <bit>

#include "engine/base/random.h"
#include "engine/render/wireframe.h"

namespace fjord {
namespace {

// Sums a hash of every leaf: sums do not depend on the order of arrival.
class LeafSum final : public StreamSink {
 public:
  explicit LeafSum(uint64_t object) : object_(object) {}

  bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }

  void Take(const StreamBatch& batch) override {
    hashes_.clear();
    for (const StreamVertex& v : batch.vertices) hashes_.push_back(HashVertex(v));
    // A leaf's own hash does not depend on its first corner either.
    for (const Triangle& t : batch.triangles) {
      AddLeaf(hashes_[t[0]] + hashes_[t[1]] + hashes_[t[2]]);
    }
    for (const auto& s : batch.segments) AddLeaf(hashes_[s[0]] + hashes_[s[1]]);
  }

  void AppendTo(std::string* bytes) const {
    for (const uint64_t part : {count_, low_, high_}) {
      for (int shift = 56; shift >= 0; shift -= 8) {
        *bytes += static_cast<char>((part >> shift) & 255);
      }
    }
  }

 private:
  static uint64_t HashVertex(const StreamVertex& v) {
    uint64_t hash = Mix64(v.id);
    for (int k = 0; k < 3; ++k) {
      const double place = v.position[k] == 0 ? 0. : v.position[k];
      hash = Mix64(hash + std::bit_cast<uint64_t>(place) * 0x9e3779b97f4a7c15u + 1);
    }
    return hash;
  }

  void AddLeaf(uint64_t vertices) {
    ++count_;
    low_ += Mix64(vertices + object_);
    high_ += Mix64(~vertices * 0xbf58476d1ce4e5b9u + object_);
  }

  uint64_t object_;
  uint64_t count_ = 0, low_ = 0, high_ = 0;
  std::vector<uint64_t> hashes_;
};

}  // namespace

Digest GeometryDigest(const BuiltFrame& frame) {
  constexpr size_t kPatch = 2048;
  std::string bytes = "fjord-geometry 1\n";
  for (size_t o = 0; o < frame.objects.size(); ++o) {
    LeafSum sum(o);
    const PreparedFractal& prepared = *frame.objects[o].prepared;
    for (size_t root = 0; root < prepared.RootCount(); ++root) prepared.Stream(root, sum, kPatch);
    sum.AppendTo(&bytes);
  }
  return Sha256Of(bytes);
}

}  // namespace fjord
