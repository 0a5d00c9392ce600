// Heights and placements from the scene language to the frame scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/animation/frame_geometry.h"
#include "engine/base/exact_math.h"
#include "engine/image/codec.h"
#include "tests/animation/animate.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::ErrorsOf;
using testing::FrameOf;
using ::testing::HasSubstr;
using testing::Load;

std::string Scene(const std::string& object, const std::string& more = "") {
  return "output { frames: 9 }\nobjects { name: \"a\" " + object + " }\n" + more;
}

// A grey 16-bit picture, columns by rows, that holds `sample(column, row from the top)`.
template <typename Sample>
std::string Png16(uint32_t columns, uint32_t rows, const Sample& sample) {
  Picture picture{columns, rows, PixelFormat::kPng16, {}};
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const uint16_t value = sample(x, y);
      for (int k = 0; k < 3; ++k) {
        const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
        picture.bytes.insert(picture.bytes.end(), bytes, bytes + 2);
      }
    }
  }
  const Result<std::string> bytes = EncodePicture(picture, {});
  EXPECT_TRUE(bytes.ok());
  return bytes.ok() ? *bytes : "";
}

TEST(HeightsSceneTest, APictureOfSixteenBitsKeepsEveryStep) {
  const std::string png = Png16(
      3, 2, [](uint32_t x, uint32_t y) { return static_cast<uint16_t>(y == 0 ? 65535 - x : x); });
  const auto animation =
      Animate(Scene("shape { heights { file { path: \"h.png\" } size { x: 4 y: 2 z: .5 } } }"), {},
              {{"h.png", png}});
  const v1::FrameHeights heights = FrameOf(*animation, 1).object(0).heights();
  EXPECT_EQ(heights.columns(), 3u);
  EXPECT_EQ(heights.rows(), 2u);
  ASSERT_EQ(heights.sample_size(), 6);
  for (int x = 0; x < 3; ++x) {  // the top row of the picture lies at the largest y
    EXPECT_EQ(heights.sample(x), double{static_cast<float>(x) / 65535.f});
    EXPECT_EQ(heights.sample(3 + x), double{static_cast<float>(65535 - x) / 65535.f});
  }
  EXPECT_EQ(heights.size(2), .5);
  EXPECT_GT(heights.fineness().pixels(), 0);
}

// As programs that make heights write them: one channel of 16 bits. 65535 65534 65533 over 0 1 258.
TEST(HeightsSceneTest, GreyPicturesAreRead) {
  const std::string hex =
      "89504e470d0a1a0a0000000d4948445200000003000000021000000000e88fe585000000194944415478"
      "01010e00f1ff00fffffffefffd000000000101023ebc05fcd3bed66a0000000049454e44ae426082";
  std::string png;
  for (size_t i = 0; i < hex.size(); i += 2) {
    png += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  const auto animation =
      Animate(Scene("shape { heights { file { path: \"h.png\" } } }"), {}, {{"h.png", png}});
  ASSERT_NE(animation, nullptr);
  const v1::FrameHeights heights = FrameOf(*animation, 1).object(0).heights();
  ASSERT_EQ(heights.sample_size(), 6);
  const int wanted[] = {0, 1, 258, 65535, 65534, 65533};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(heights.sample(i), double{static_cast<float>(wanted[i]) / 65535.f}) << i;
  }
}

TEST(HeightsSceneTest, LargeHeightsAreNamedAndStayOneInMemory) {
  const std::string png = Png16(
      100, 80, [](uint32_t x, uint32_t y) { return static_cast<uint16_t>(x * 91 + y * 313); });
  const auto animation = Animate(
      Scene("shape { heights { file { path: \"h.png\" } } }",
            "track { path: \"objects[a].shape.heights.size.z\" key { frame: 1 value: 0 } key { "
            "frame: 9 value: 2 } }"),
      {}, {{"h.png", png}});
  AssetSet first, last;
  const auto a = animation->Inbetween(1, &first), b = animation->Inbetween(9, &last);
  ASSERT_TRUE(a.ok() && b.ok());
  const v1::FrameHeights &low = a->object(0).heights(), &high = b->object(0).heights();
  EXPECT_EQ(low.sample_size(), 0);
  EXPECT_EQ(low.sample_asset().numbers(), 8000u);
  EXPECT_EQ(low.sample_asset().digest(), high.sample_asset().digest());
  const Digest digest = *ParseDigest(low.sample_asset().digest());
  ASSERT_TRUE(first.Find(digest).ok() && last.Find(digest).ok());
  EXPECT_EQ(*first.Find(digest), *last.Find(digest));
  // the size moves, the rest pose and the fineness stay
  EXPECT_EQ(low.size(2), 0);
  EXPECT_EQ(low.rest_size(2), 2);
  EXPECT_EQ(high.size(2), 2);
  EXPECT_EQ(high.rest_size_size(), 0);
  EXPECT_EQ(low.fineness().SerializeAsString(), high.fineness().SerializeAsString());
  EXPECT_TRUE(FrameKey(*a).ok());
  EXPECT_NE(*FrameKey(*a), *FrameKey(*b));
}

TEST(HeightsSceneTest, WithAFractalTheyAreAMesh) {
  const auto animation = Animate(
      Scene("shape { heights { columns: 3 z: [0, 1, 2, 3, 4, 5] size { x: 2 y: 1 z: .1 } } } "
            "fractal { method: \"surface\" }"));
  const v1::FrameObject object = FrameOf(*animation, 1).object(0);
  EXPECT_FALSE(object.has_heights());
  EXPECT_EQ(object.point_size(), 18);
  EXPECT_EQ(object.face_size_size(), 4);
  EXPECT_EQ(object.point(17), .5);
}

TEST(HeightsSceneTest, AGridOfMoreThanAMeshHoldsIsDrawnAsHeights) {
  const std::string grid =
      "shape { primitive { kind: GRID size { x: 2 y: 2 } segments: 4096 rings: 4096 } } ";
  const auto animation = Animate(Scene(grid));
  ASSERT_NE(animation, nullptr);
  const v1::FrameScene frame = FrameOf(*animation, 1);
  EXPECT_EQ(frame.object(0).heights().columns(), 4097u);
  EXPECT_EQ(frame.object(0).heights().sample_size(), 0);
  EXPECT_LT(frame.ByteSizeLong(), 2000u);
  EXPECT_THAT(ErrorsOf(Load(Scene(grid + "fractal {}"))),
              HasSubstr("4097 x 4097 points are more than the 16000000"));
}

TEST(HeightsSceneTest, DefectsHaveTheirPlace) {
  const auto errors = [](const std::string& shape, const std::string& more = "") {
    return ErrorsOf(Load(Scene("shape { heights { " + shape + " } }", more)));
  };
  EXPECT_THAT(errors("columns: 3 z: [1, 2, 3, 4]"), HasSubstr("whole rows"));
  EXPECT_THAT(errors("z: [1, 2, 3, 4]"), HasSubstr("whole rows"));
  EXPECT_THAT(errors("columns: 2 z: [1, 2, 3, 1e9]"), HasSubstr("column 2, row 2"));
  EXPECT_THAT(errors("columns: 2 z: [1, 2, 3, 4] file { path: \"x.png\" }"), HasSubstr("x.png"));
  EXPECT_THAT(errors("columns: 2 z: [1, 2, 3, 4] size { x: -1 y: 1 }"), HasSubstr("size"));
  EXPECT_THAT(errors("columns: 2 z: [1, 2, 3, 4] pixels: 1 epsilon: 1"),
              HasSubstr("pixels or epsilon"));
  EXPECT_THAT(
      errors("columns: 2 z: [1, 2, 3, 4]",
             "track { path: \"objects[a].shape.heights.pixels\" key { frame: 1 value: 1 } }"),
      HasSubstr("of heights only the size can change"));
  EXPECT_THAT(ErrorsOf(Load(Scene("shape { heights { file { path: \"x.png\" } } }"), {},
                            {{"x.png", "no picture"}})),
              HasSubstr("x.png"));
}

const std::string kBall =
    "shape { primitive { kind: SPHERE } } fractal { method: \"surface\" pixels: 2 } ";

TEST(PlacementsSceneTest, EachHasItsMapAndTheObjectOneFineness) {
  const auto animation = Animate(
      Scene(kBall +
            "placements { translate { x: 3 } scale { x: 2 y: 2 z: 2 } } placements { rotate { z: "
            "90 } } transform { translate { z: 1 } }"));
  const v1::FrameObject object = FrameOf(*animation, 1).object(0);
  ASSERT_EQ(object.placement_size(), 24);
  EXPECT_EQ(object.placement(0), 2);
  EXPECT_EQ(object.placement(3), 3);
  EXPECT_EQ(object.placement(12 + 5), 0);
  EXPECT_EQ(object.transform_size(), 12);
}

TEST(PlacementsSceneTest, S25_NoPlacementIsCoarserThanAlone) {
  const std::string camera =
      "camera { eye { x: 0 y: -20 z: 3 } look_at {} }\n"
      "track { path: \"camera.eye\" key { frame: 1 value: [0, -20, 3] } key { frame: 9 value: [4, "
      "-6, "
      "3] } }\n";
  std::string all = kBall, largest;
  std::vector<std::pair<Vec3, Vec3>> alone;
  for (int i = 0; i < 150; ++i) {
    const std::string place = "translate { x: " + std::to_string(i % 15 - 7) +
                              " y: " + std::to_string(i / 15) + " } scale { x: ." +
                              std::to_string(1 + i % 7) + " y: .3 z: .2 }";
    all += "placements { " + place + " } ";
    alone.emplace_back(Vec3(i % 15 - 7, i / 15, 0), Vec3(.1 + .1 * (i % 7), .3, .2));
  }
  const v1::FrameFineness shared =
      FrameOf(*Animate(Scene(all, camera)), 5).object(0).fractal().fineness();
  EXPECT_EQ(shared.focal(), 0);
  // Alone: a ball's box, seen from the nearest place of the camera, in a picture of 540 lines.
  const double focal =
      270 / exact::Sin(17.5 * exact::kPi / 180) * exact::Cos(17.5 * exact::kPi / 180);
  double finest = 1e100;
  for (const auto& [middle, radii] : alone) {
    const Vec3 eye(4, -6, 3);
    Vec3 apart(0);
    for (int k = 0; k < 3; ++k) {
      apart[k] = std::max(0., std::max(eye[k] - middle[k], middle[k] - eye[k]) - radii[k]);
    }
    finest = std::min(finest, 2 * Length(apart) / focal / std::max({radii.x, radii.y, radii.z}));
  }
  EXPECT_LE(shared.epsilon(), finest * (1 + 1e-9));
  EXPECT_GT(shared.epsilon(), finest / 3) << "and not much finer";
}

TEST(PlacementsSceneTest, ManyAreNamedAndTheCameraSeesThemAll) {
  std::string all = kBall;
  for (int i = 0; i < 1000; ++i) {
    all += "placements { translate { x: " + std::to_string(i % 40) +
           " y: " + std::to_string(i / 40) + " } } ";
  }
  const auto animation = Animate(Scene(all));
  AssetSet assets;
  const auto frame = animation->Inbetween(1, &assets);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->object(0).placement_asset().numbers(), 12'000u);
  const auto placements = PlacementsOf(frame->object(0), &assets);
  ASSERT_TRUE(placements.ok());
  EXPECT_EQ(placements->size(), 1000u);
  EXPECT_EQ((*placements)[41][3], 1);
  EXPECT_NEAR(animation->scene().camera().look_at().x(), 19.5, .1);
}

TEST(PlacementsSceneTest, WhatCannotBeIsSaid) {
  EXPECT_THAT(
      ErrorsOf(Load(Scene(kBall + "placements {}",
                          "track { path: \"objects[a].placements[1].translate.x\" key { frame: 1 "
                          "value: 1 } }"))),
      HasSubstr("placements stand still"));
  EXPECT_THAT(
      ErrorsOf(Load(Scene("shape { primitive { kind: SPHERE } } fractal { split: ADAPTIVE } "
                          "placements {}"))),
      HasSubstr("ADAPTIVE looks at one place"));
}

TEST(CoarseFacesTest, MethodsGetTheFacesThatTheyTake) {
  v1::FrameObject object;
  for (const double value : {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., .5, 2., 0.})
    object.add_point(value);
  for (const uint32_t size : {4u, 3u}) object.add_face_size(size);
  for (const uint32_t vertex : {0u, 1u, 2u, 3u, 3u, 2u, 4u}) object.add_face_vertex(vertex);
  const Result<CoarseShape> faces = CoarseShapeOf(object, nullptr, Takes::kFaces);
  ASSERT_TRUE(faces.ok());
  EXPECT_THAT(faces->face_size, ::testing::ElementsAre(4, 3));
  EXPECT_THAT(faces->face_vertex, ::testing::ElementsAre(0, 1, 2, 3, 3, 2, 4));
  EXPECT_TRUE(faces->triangles.empty());
  const Result<CoarseShape> triangles = CoarseShapeOf(object, nullptr, Takes::kTriangles);
  ASSERT_TRUE(triangles.ok());
  EXPECT_EQ(triangles->triangles.size(), 3u);
  EXPECT_TRUE(triangles->face_size.empty());
}

}  // namespace
}  // namespace fjord
