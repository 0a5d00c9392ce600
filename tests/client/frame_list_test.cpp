// Folders as people leave them: numbers of any width and at any place, gaps, other pictures beside.
#include "client/frame_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "client/files.h"
#include "client/manifest.h"
#include "engine/base/digest.h"
#include "engine/image/codec.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FrameListTest : public ::testing::Test {
 protected:
  FrameListTest() {
    std::string pattern = (fs::temp_directory_path() / "fjord-frames-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~FrameListTest() override { fs::remove_all(folder_); }

  void Touch(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      fs::create_directories(fs::path(folder_ + "/" + name).parent_path());
      ASSERT_TRUE(WriteFileAtomically(folder_ + "/" + name, name).ok());
    }
  }
  // Frames 1 to `total` are the animation; those of `there` are named, with their files.
  void WriteManifest(uint32_t total, const std::vector<uint32_t>& there) {
    Manifest manifest;
    manifest.name = "hill";
    manifest.frames_total = total;
    manifest.rate = 25;
    for (const uint32_t number : there) {
      const std::string file = FrameFileName("hill", number, "png");
      Touch({file});
      manifest.frames[number] = {file, Sha256Of(file).Hex(), Sha256Of("key " + file).Hex()};
    }
    ASSERT_TRUE(WriteFileAtomically(folder_ + "/" + kManifestName, ManifestText(manifest)).ok());
  }

  std::vector<std::string> Names(const FrameChoice& choice = {}) {
    const Result<FrameList> list = FramesOf(folder_, choice);
    if (!list.ok()) return {"error: " + list.error().message};
    std::vector<std::string> names;
    for (const ListedFrame& frame : list->frames)
      names.push_back(frame.file.substr(folder_.size() + 1));
    return names;
  }
  std::string Objection(const FrameChoice& choice = {}) {
    const Result<FrameList> list = FramesOf(folder_, choice);
    return list.ok() ? "" : list.error().message;
  }

  std::string folder_;
};

FrameChoice Missing() { return {{}, true, false}; }
FrameChoice Mixed() { return {{}, false, true}; }
FrameChoice Only(const std::string& frames) { return {*FrameSet::Parse(frames), false, false}; }

TEST_F(FrameListTest, AFrameThatTheManifestLacksIsNamed) {
  WriteManifest(12, {1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 12});
  EXPECT_THAT(Objection(), HasSubstr("frame 4 of 12 is missing; "));
  EXPECT_THAT(Objection(), HasSubstr("--allow-missing"));
  EXPECT_EQ(Names(Missing()).size(), 11u);
  EXPECT_THAT(Names(Only("3,5")), ElementsAre("hill.0003.png", "hill.0005.png"));
  EXPECT_THAT(Objection(Only("3-5")), HasSubstr("frame 4 of 12 is missing"));
}

TEST_F(FrameListTest, FramesMissingAtTheEndsAreMissing) {
  WriteManifest(12, {3, 4, 5, 8});
  EXPECT_THAT(Objection(), HasSubstr("frames 1-2,6-7,9-12 of 12 are missing"));
}

TEST_F(FrameListTest, AFileThatIsGoneIsMissingThoughTheManifestNamesIt) {
  WriteManifest(3, {1, 2, 3});
  fs::remove(folder_ + "/hill.0002.png");
  EXPECT_THAT(Objection(), HasSubstr("frame 2 of 3 is missing"));
  EXPECT_THAT(Names(Missing()), ElementsAre("hill.0001.png", "hill.0003.png"));
}

TEST_F(FrameListTest, PicturesOfAnOlderVersionDoNotFillTheGapsOfAManifest) {
  Touch({"hill.0003.png", "hill.0004.png"});
  WriteManifest(4, {1, 2});
  EXPECT_THAT(Objection(), HasSubstr("frames 3-4 of 4 are missing"));
}

TEST_F(FrameListTest, APictureThatIsNotTheManifestsIsRefused) {
  const Picture picture = Quantise(1, 1, PixelFormat::kPng8, std::vector<float>{.5f, .5f, .5f});
  const std::string file = folder_ + "/a.png";
  ASSERT_TRUE(WriteFileAtomically(file, *EncodePicture(picture, {})).ok());
  EXPECT_TRUE(ReadFrame({file, {}}).ok());
  EXPECT_TRUE(ReadFrame({file, PixelDigest(picture).Hex()}).ok());
  const Result<Picture> other = ReadFrame({file, Sha256Of("another").Hex()});
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message, HasSubstr("not the picture that manifest.json names"));
}

TEST_F(FrameListTest, NumbersSortAsNumbers) {
  Touch({"a.9998.png", "a.9999.png", "a.10000.png"});
  EXPECT_THAT(Names(), ElementsAre("a.9998.png", "a.9999.png", "a.10000.png"));
}

TEST_F(FrameListTest, NumbersWithoutPaddingSortAsNumbers) {
  std::vector<std::string> names;
  for (int i = 1; i <= 12; ++i) names.push_back("shot_" + std::to_string(i) + ".png");
  Touch(names);
  EXPECT_EQ(Names(), names);
}

TEST_F(FrameListTest, TheNumberMayStandAnywhere) {
  Touch({"2_v2.png", "10_v2.png", "9_v2.png"});
  EXPECT_THAT(Objection(), HasSubstr("frames 3-8 of #_v2.png are missing"));
  EXPECT_THAT(Names(Missing()), ElementsAre("2_v2.png", "9_v2.png", "10_v2.png"));
}

TEST_F(FrameListTest, MissingNumbersAreNamedWithoutAManifest) {
  Touch({"a.0999.png", "a.1000.png", "a.1003.png"});
  EXPECT_THAT(Objection(), HasSubstr("frames 1001-1002 of a.#.png are missing"));
  Touch({"a.1001.png"});
  EXPECT_THAT(Objection(), HasSubstr("frame 1002 of a.#.png is missing"));
  EXPECT_THAT(Names(Only("999-1001")), ElementsAre("a.0999.png", "a.1000.png", "a.1001.png"));
  EXPECT_THAT(Objection(Only("998-1000")), HasSubstr("frame 998 of a.#.png is missing"));
}

TEST_F(FrameListTest, TwoScenesInOneFolderAreNotOneMovie) {
  Touch({"a.1.png", "a.2.png", "b.1.png", "b.2.png"});
  EXPECT_THAT(Objection(), HasSubstr("more than one sequence: a.#.png (2), b.#.png (2)"));
  EXPECT_THAT(Names(Mixed()), ElementsAre("a.1.png", "a.2.png", "b.1.png", "b.2.png"));
}

TEST_F(FrameListTest, TwoVersionsAndFoldersAndFormatsAreTwoSequences) {
  Touch({"v1_1.png", "v1_2.png", "v2_1.png", "v2_2.png"});
  EXPECT_THAT(Objection(), HasSubstr("v1_#.png (2), v2_#.png (2)"));
  fs::remove_all(folder_);
  Touch({"a.1.png", "beauty/a.2.png"});
  EXPECT_THAT(Objection(), HasSubstr("more than one sequence"));
  fs::remove_all(folder_);
  Touch({"a.1.png", "a.2.exr"});
  EXPECT_THAT(Objection(), HasSubstr("a.2.exr, a.1.png"));
}

TEST_F(FrameListTest, AContactSheetBesideTheFramesIsNoticed) {
  Touch({"a.1.png", "a.2.png", "sheet.png"});
  EXPECT_THAT(Objection(), HasSubstr("a.#.png (2), sheet.png"));
}

TEST_F(FrameListTest, OneNumberTwiceIsSaid) {
  Touch({"a.1.png", "a.01.png", "a.2.png"});
  EXPECT_THAT(Objection(), HasSubstr("a.01.png and a.1.png have the same number"));
}

TEST_F(FrameListTest, NamesOfEveryScriptAreTheirOwn) {
  // The same sound in two scripts, and one letter in two encodings of Unicode.
  Touch({"\u5c71.1.png", "\u6d77.1.png"});
  EXPECT_THAT(Objection(), HasSubstr("\u5c71.1.png, \u6d77.1.png"));
  fs::remove_all(folder_);
  Touch({"\u00e9.1.png", "e\u0301.2.png"});
  EXPECT_THAT(Objection(), HasSubstr("more than one sequence"));
  fs::remove_all(folder_);
  Touch({"\u5c71.2.png", "\u5c71.10.png", "\u5c71.1.png"});
  EXPECT_THAT(Names(Missing()), ElementsAre("\u5c71.1.png", "\u5c71.2.png", "\u5c71.10.png"));
  EXPECT_THAT(Objection(), HasSubstr("frames 3-9 of \u5c71.#.png are missing"));
}

TEST_F(FrameListTest, PicturesWithoutNumbersAreInTheOrderOfTheirNames) {
  Touch({"night.png", "day.png"});
  EXPECT_THAT(Names(), ElementsAre("day.png", "night.png"));
}

TEST_F(FrameListTest, AFolderWithoutFramesIsSaid) {
  Touch({"notes.txt"});
  EXPECT_THAT(Objection(), HasSubstr("there are no frames in this folder"));
}

}  // namespace
}  // namespace fjord
