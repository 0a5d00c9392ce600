// Lists by digest: the bytes that are digested are frozen (docs/frame_key.md).
#include "engine/asset/asset.h"

#include <string>

#include "gtest/gtest.h"

namespace fjord {
namespace {

std::string Bytes(std::initializer_list<int> bytes) {
  std::string text;
  for (const int byte : bytes) text += static_cast<char>(byte);
  return text;
}

const std::string kOne = Bytes({0x3f, 0xf0, 0, 0, 0, 0, 0, 0});
const std::string kHalf = Bytes({0x3f, 0xe0, 0, 0, 0, 0, 0, 0});
const std::string kZero(8, '\0');

TEST(AssetTest, TheDigestIsThatOfTheDocumentedBytes) {
  const SharedAsset points = MakeAsset(PointList{{1, .5, 0}, {0, 0, 1}});
  EXPECT_EQ(points->digest,
            Sha256Of("fjord-asset 1 points 2\n" + kOne + kHalf + kZero + kZero + kZero + kOne));
  EXPECT_EQ(points->numbers, 6u);
  const SharedAsset colors = MakeAsset(ColorList{{.5f, 0, 1}});
  EXPECT_EQ(colors->digest, Sha256Of("fjord-asset 1 colors 1\n" + kHalf + kZero + kOne));
  EXPECT_EQ(colors->numbers, 3u);
  const SharedAsset faces = MakeAsset(FaceList{{3}, {0, 1, 258}});
  EXPECT_EQ(faces->digest, Sha256Of("fjord-asset 1 faces 1 3\n" +
                                    Bytes({0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 2})));
  EXPECT_EQ(faces->numbers, 4u);
}

TEST(AssetTest, LongListsAreDigestedWhole) {
  PointList points(10'000, Vec3(1, 0, .5));
  std::string bytes = "fjord-asset 1 points 10000\n";
  for (size_t i = 0; i < points.size(); ++i) bytes += kOne + kZero + kHalf;
  EXPECT_EQ(MakeAsset(points)->digest, Sha256Of(bytes));
}

TEST(AssetTest, MinusZeroIsZero) {
  EXPECT_EQ(MakeAsset(PointList{{-0., 1, 2}})->digest, MakeAsset(PointList{{0, 1, 2}})->digest);
}

TEST(AssetTest, ASetFindsWhatItWasGiven) {
  AssetSet set;
  const SharedAsset asset = MakeAsset(PointList{{1, 2, 3}});
  set.Add(asset);
  set.Add(MakeAsset(PointList{{1, 2, 3}}));
  EXPECT_EQ(set.size(), 1u);
  const Result<SharedAsset> found = set.Find(asset->digest);
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(*found, asset);
  const Result<SharedAsset> other = set.Find(Sha256Of("another"));
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace fjord
