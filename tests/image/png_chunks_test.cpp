#include "engine/image/png_chunks.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/image/codec.h"

namespace fjord {
namespace {

std::string SmallPng() {
  const std::vector<float> linear(3 * 4 * 2, .5f);
  return EncodePicture(Quantise(4, 2, PixelFormat::kPng8, linear), {{"seed", "7"}}).value();
}

TEST(PngChunksTest, WhatIsWrittenPasses) { EXPECT_TRUE(CheckPngChunks(SmallPng(), 16384)); }

TEST(PngChunksTest, EveryCutIsSeen) {
  const std::string bytes = SmallPng();
  for (size_t n = 8; n < bytes.size(); ++n) {
    EXPECT_FALSE(CheckPngChunks(std::string_view(bytes).substr(0, n), 16384)) << n;
  }
}

TEST(PngChunksTest, AChunkThatClaimsGigabytesIsRefusedBeforeTheLibrarySeesIt) {
  std::string bytes = SmallPng();
  bytes[bytes.find("tEXt") - 4] = 0x7a;
  EXPECT_FALSE(CheckPngChunks(bytes, 16384));
  EXPECT_EQ(DecodePicture(bytes, "lie.png").error().place.ToString(), "lie.png");
}

TEST(PngChunksTest, SidesBeyondTheBoundAreRefused) {
  for (size_t at : {16u, 20u}) {
    std::string bytes = SmallPng();
    bytes[at + 2] = 0x41;
    const auto picture = DecodePicture(bytes, "lie.png");
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::kLimit);
    bytes = SmallPng();
    bytes[at + 3] = 0;
    EXPECT_FALSE(CheckPngChunks(bytes, 16384));
  }
}

}  // namespace
}  // namespace fjord
