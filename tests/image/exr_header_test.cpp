#include "engine/image/exr_header.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/image/codec.h"

namespace fjord {
namespace {

std::string SmallExr() {
  const std::vector<float> linear(3 * 4 * 2, .5f);
  return EncodePicture(Quantise(4, 2, PixelFormat::kExrHalf, linear), {}).value();
}

// Where the value of an attribute starts.
size_t ValueOf(const std::string& bytes, const std::string& name, const std::string& type) {
  const std::string start = name + '\0' + type + '\0';
  return bytes.find(start) + start.size() + 4;
}

TEST(ExrHeaderTest, WhatIsWrittenPasses) { EXPECT_TRUE(CheckExrHeader(SmallExr(), 16384)); }

TEST(ExrHeaderTest, EveryCutInTheHeaderIsSeen) {
  const std::string bytes = SmallExr();
  const size_t end = ValueOf(bytes, "screenWindowWidth", "float") + 4;
  for (size_t n = 4; n < end; ++n) {
    EXPECT_FALSE(CheckExrHeader(std::string_view(bytes).substr(0, n), 16384)) << n;
  }
}

TEST(ExrHeaderTest, SidesBeyondTheBoundAreRefusedBeforeTheLibrarySeesThem) {
  for (const char* window : {"dataWindow", "displayWindow"}) {
    for (size_t at : {8u, 12u}) {
      std::string bytes = SmallExr();
      bytes[ValueOf(bytes, window, "box2i") + at + 3] = 0x70;
      const auto picture = DecodePicture(bytes, "lie.exr");
      ASSERT_FALSE(picture) << window;
      EXPECT_EQ(picture.error().code, ErrorCode::kLimit);
      EXPECT_EQ(picture.error().place.ToString(), "lie.exr");
      bytes[ValueOf(bytes, window, "box2i") + at + 3] = '\x80';  // ends before it begins
      EXPECT_FALSE(CheckExrHeader(bytes, 16384));
    }
  }
}

TEST(ExrHeaderTest, DeepAndMultiPartFilesAreRefused) {
  for (const char flag : {'\x08', '\x10'}) {
    std::string bytes = SmallExr();
    bytes[5] = static_cast<char>(bytes[5] | flag);
    EXPECT_FALSE(CheckExrHeader(bytes, 16384));
  }
}

}  // namespace
}  // namespace fjord
