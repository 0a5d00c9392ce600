#include "engine/image/codec.h"

#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "engine/base/random.h"
#include "gtest/gtest.h"

namespace fjord {
namespace {

constexpr PixelFormat kFormats[] = {PixelFormat::kPng8, PixelFormat::kPng16, PixelFormat::kExrHalf,
                                    PixelFormat::kExrFloat};

Picture Noise(uint32_t width, uint32_t height, PixelFormat format) {
  std::vector<float> linear(size_t{width} * height * 3);
  for (size_t i = 0; i < linear.size(); ++i) {
    linear[i] = static_cast<float>(Mix64(i) >> 40) * 0x1p-24f;
  }
  return Quantise(width, height, format, linear);
}

TEST(CodecTest, WhatIsWrittenIsRead) {
  const PictureInfo info = {{"frame_key", "abc"}, {"object_1", "method=surface seed=7 H=0.7"}};
  for (const PixelFormat format : kFormats) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {37u, 23u}, {300u, 200u}}) {
      const Picture picture = Noise(width, height, format);
      const Result<std::string> bytes = EncodePicture(picture, info);
      ASSERT_TRUE(bytes.ok()) << bytes.error().message;
      PictureInfo read;
      const Result<Picture> back = DecodePicture(*bytes, "test", &read);
      ASSERT_TRUE(back.ok()) << back.error().message;
      EXPECT_EQ(back->width, width);
      EXPECT_EQ(back->height, height);
      EXPECT_EQ(back->format, format);
      EXPECT_EQ(back->bytes, picture.bytes);
      EXPECT_EQ(PixelDigest(*back), PixelDigest(picture));
      for (const auto& entry : info) {
        EXPECT_NE(std::find(read.begin(), read.end(), entry), read.end()) << entry.first;
      }
    }
  }
}

// Straight and associated samples come back as they are; no library multiplies them.
TEST(CodecTest, AlphaIsWrittenAndReadAsItIs) {
  for (const PixelFormat format : kFormats) {
    std::vector<float> linear;
    for (uint32_t i = 0; i < 37 * 23; ++i) {
      const auto part = [&](uint32_t k) {
        return static_cast<float>(Mix64(4 * i + k) >> 40) * 0x1p-24f;
      };
      const float alpha = i % 5 == 0 ? 0.f : i % 5 == 1 ? 1.f : part(3);
      for (uint32_t k = 0; k < 3; ++k) linear.push_back(part(k) * alpha);
      linear.push_back(alpha);
    }
    Picture picture = Quantise(37, 23, format, linear, Channels::kRgba);
    ASSERT_EQ(picture.bytes.size(), 37u * 23 * 4 * BytesPerSample(format));
    const bool exr = FileEnding(format) == std::string_view("exr");
    if (exr) picture.layers.push_back({"depth", std::vector<float>(37 * 23, 2.5f)});
    const Result<std::string> bytes = EncodePicture(picture, {});
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    if (!exr) {
      EXPECT_EQ((*bytes)[25], 6) << "colour type of truecolour with alpha";
    }
    const Result<Picture> back = DecodePicture(*bytes, "test");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_TRUE(back->alpha);
    EXPECT_EQ(back->bytes, picture.bytes);
    EXPECT_EQ(back->layers.size(), picture.layers.size());
    EXPECT_EQ(PixelDigest(*back), PixelDigest(picture));
  }
}

TEST(CodecTest, LayersAreWrittenBesideTheColoursAndTheirDigestsJoined) {
  for (const PixelFormat format : {PixelFormat::kExrHalf, PixelFormat::kExrFloat}) {
    Picture picture = Noise(37, 23, format);
    const Digest color = PixelDigest(picture);
    PictureLayer depth{"depth", {}};
    for (size_t i = 0; i < 37 * 23; ++i) depth.samples.push_back(static_cast<float>(i) * .37f);
    depth.samples[5] = std::numeric_limits<float>::infinity();
    picture.layers.push_back(depth);
    const Result<std::string> bytes = EncodePicture(picture, {});
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    const Result<Picture> back = DecodePicture(*bytes, "test");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->format, format);
    EXPECT_EQ(back->bytes, picture.bytes);
    ASSERT_EQ(back->layers.size(), 1u);
    EXPECT_EQ(back->layers[0].name, "depth");
    EXPECT_EQ(back->layers[0].samples, depth.samples);
    EXPECT_EQ(PixelDigest(*back), PixelDigest(picture));

    // One digest each, in name order, digested again.
    Sha256 of_depth;
    of_depth.Update("fjord-pixels 1 37 23 1 float\n");
    for (const float sample : depth.samples) {
      const auto bits = std::bit_cast<uint32_t>(sample);
      for (const int shift : {24, 16, 8, 0}) {
        const auto byte = static_cast<uint8_t>(bits >> shift);
        of_depth.Update(std::span<const uint8_t>(&byte, 1));
      }
    }
    Sha256 joined;
    joined.Update(color.bytes);
    joined.Update(of_depth.Finish().bytes);
    EXPECT_EQ(PixelDigest(picture), joined.Finish());
    EXPECT_NE(PixelDigest(picture), color);
  }
  Picture png = Noise(3, 2, PixelFormat::kPng8);
  png.layers.push_back({"depth", std::vector<float>(6, 1.f)});
  EXPECT_FALSE(EncodePicture(png, {}).ok());
}

TEST(CodecTest, EqualPicturesGiveEqualFilesWithoutDatesOrNames) {
  for (const PixelFormat format : kFormats) {
    const Picture picture = Noise(20, 10, format);
    const Result<std::string> a = EncodePicture(picture, {{"frame_key", "k"}});
    const Result<std::string> b = EncodePicture(picture, {{"frame_key", "k"}});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(*a, *b);
    for (const char* word : {"OpenImageIO", "Software", "DateTime", "tIME", ":20"}) {
      EXPECT_EQ(a->find(word), std::string::npos) << word << " in " << FileEnding(format);
    }
  }
}

TEST(CodecTest, BrokenBytesAreErrorsThatNameTheFile) {
  for (const PixelFormat format : {PixelFormat::kPng8, PixelFormat::kExrHalf}) {
    const Result<std::string> whole = EncodePicture(Noise(40, 40, format), {});
    ASSERT_TRUE(whole.ok());
    for (const size_t length : {size_t{0}, size_t{3}, size_t{8}, size_t{60}, whole->size() / 2}) {
      const Result<Picture> read = DecodePicture(whole->substr(0, length), "cut.png");
      ASSERT_FALSE(read.ok()) << length;
      EXPECT_EQ(read.error().place.file, "cut.png");
    }
  }
  EXPECT_FALSE(DecodePicture("GIF89a and more", "x").ok());
}

TEST(CodecTest, SizesBeyondTheLimitAreRefusedBeforeAnythingIsHeld) {
  // A PNG header that claims 20000 x 20000.
  const Result<std::string> small = EncodePicture(Noise(4, 4, PixelFormat::kPng8), {});
  ASSERT_TRUE(small.ok());
  std::string lie = *small;
  lie[16] = lie[20] = 0, lie[17] = lie[21] = 0, lie[18] = lie[22] = 0x4e, lie[19] = lie[23] = 0x20;
  EXPECT_FALSE(DecodePicture(lie, "lie.png").ok());
}

class WriteFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "fjord-write-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string Read(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  size_t FileCount() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }

  std::string folder_;
};

TEST_F(WriteFileTest, WritesAndReplaces) {
  const std::string path = folder_ + "/a b.png";
  ASSERT_TRUE(WriteFileAtomically(path, "one").ok());
  ASSERT_TRUE(WriteFileAtomically(path, std::string(3000000, 'x')).ok());
  EXPECT_EQ(Read(path), std::string(3000000, 'x'));
  EXPECT_EQ(FileCount(), 1u);
}

TEST_F(WriteFileTest, FailuresNameThePathAndLeaveNothing) {
  const Result<> missing = WriteFileAtomically(folder_ + "/none/a.png", "x");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
  EXPECT_EQ(missing.error().place.file, folder_ + "/none/a.png");
  EXPECT_NE(missing.error().message.find("make the folder"), std::string::npos);
  // A folder stands where the file should go.
  ASSERT_EQ(mkdir((folder_ + "/taken").c_str(), 0777), 0);
  std::ofstream(folder_ + "/taken/inside") << "x";
  EXPECT_FALSE(WriteFileAtomically(folder_ + "/taken", "x").ok());
  EXPECT_EQ(FileCount(), 1u);
}

}  // namespace
}  // namespace fjord
