// Short lists stand in a frame scene, long ones are named; one rule, one form, one key.
#include "engine/animation/frame_geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/animation/animate.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;
using ::testing::HasSubstr;

// 31 x 31 points: 2883 numbers, 7200 of faces; 41 x 41 points: 5043 numbers.
std::string Grid(int cells, const std::string& more = "") {
  return "output { frames: 9 }\nobjects { name: \"a\" shape { primitive { kind: GRID size { x: 2 "
         "y: 2 }"
         " segments: " +
         std::to_string(cells) + " rings: " + std::to_string(cells) + " } } " + more + " }\n";
}

TEST(FrameGeometryTest, LengthAloneDecidesWhatIsNamed) {
  const v1::FrameObject small = FrameOf(*Animate(Grid(8)), 1).object(0);
  EXPECT_EQ(small.point_size(), 3 * 81);
  EXPECT_FALSE(small.has_point_asset() || small.has_face_asset());
  const v1::FrameObject middle = FrameOf(*Animate(Grid(30)), 1).object(0);
  EXPECT_EQ(middle.point_size(), 3 * 31 * 31);
  EXPECT_FALSE(middle.has_point_asset());
  EXPECT_EQ(middle.face_asset().numbers(), 4u * 1800);
  EXPECT_EQ(middle.face_size_size() + middle.face_vertex_size(), 0);
  const v1::FrameObject large = FrameOf(*Animate(Grid(40)), 1).object(0);
  EXPECT_EQ(large.point_size(), 0);
  EXPECT_EQ(large.point_asset().numbers(), 3u * 41 * 41);
  EXPECT_FALSE(large.has_rest_asset()) << "the rest pose is the same";
}

TEST(FrameGeometryTest, NamedListsGiveTheShapeBack) {
  const std::string text =
      "output { frames: 9 }\nobjects { name: \"a\" "
      "key { frame: 1 shape { primitive { kind: GRID size { x: 2 y: 2 } segments: 40 rings: 40 } } "
      "} "
      "key { frame: 9 shape { primitive { kind: GRID size { x: 3 y: 3 } segments: 40 rings: 40 } } "
      "} }";
  const auto animation = Animate(text);
  AssetSet assets;
  const Result<v1::FrameScene> scene = animation->Inbetween(5, &assets);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(assets.size(), 3u);  // points, rest, faces
  const v1::FrameObject& object = scene->object(0);
  const Result<CoarseShape> shape = CoarseShapeOf(object, &assets);
  ASSERT_TRUE(shape.ok()) << shape.error().message;
  ASSERT_EQ(shape->now.size(), 41u * 41);
  EXPECT_EQ(shape->now[0], Vec3(-1.25, -1.25, 0));
  EXPECT_EQ(shape->rest[0], Vec3(-1.5, -1.5, 0));
  EXPECT_EQ(shape->triangles.size(), 2u * 1600);
  const Result<v1::FrameObject> written = WrittenOut(object, &assets);
  ASSERT_TRUE(written.ok());
  const Result<CoarseShape> same = CoarseShapeOf(*written, nullptr);
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->now, shape->now);
  EXPECT_EQ(same->rest, shape->rest);
  EXPECT_EQ(same->triangles, shape->triangles);
}

TEST(FrameGeometryTest, AStillListIsDigestedOnce) {
  const auto animation = Animate(Grid(40) +
                                 "track { path: \"camera.eye\" key { frame: 1 value: [0, -6, 2] } "
                                 "key { frame: 9 value: [0, -5, 3] } }");
  AssetSet first, second;
  const Result<v1::FrameScene> a = animation->Inbetween(1, &first),
                               b = animation->Inbetween(9, &second);
  ASSERT_TRUE(a.ok() && b.ok());
  const Result<Digest> digest = [&]() -> Result<Digest> {
    return *ParseDigest(a->object(0).point_asset().digest());
  }();
  EXPECT_EQ(a->object(0).point_asset().digest(), b->object(0).point_asset().digest());
  ASSERT_TRUE(first.Find(*digest).ok() && second.Find(*digest).ok());
  EXPECT_EQ(*first.Find(*digest), *second.Find(*digest))
      << "one list in memory, whatever the frame";
}

TEST(FrameGeometryTest, OtherSamplesOtherKey) {
  const auto key = [](const std::string& text) { return testing::KeyOf(*Animate(text), 1); };
  EXPECT_EQ(key(Grid(40)), key(Grid(40)));
  EXPECT_NE(key(Grid(40)), key(Grid(41)));
}

TEST(FrameGeometryTest, AKeyKnowsOneFormOnly) {
  v1::FrameScene scene = FrameOf(*Animate(Grid(8)), 1);
  ASSERT_TRUE(FrameKey(scene).ok());
  v1::FrameScene wrong = scene;
  for (int i = 0; i < 4096; ++i) wrong.mutable_object(0)->add_point(1);
  EXPECT_THAT(FrameKey(wrong).error().message, HasSubstr("more than 4096 numbers are named"));
  const SharedAsset short_list = MakeAsset(PointList(5));
  wrong = scene;
  wrong.mutable_object(0)->clear_point();
  wrong.mutable_object(0)->mutable_point_asset()->set_digest(short_list->digest.Hex());
  wrong.mutable_object(0)->mutable_point_asset()->set_numbers(15);
  EXPECT_THAT(FrameKey(wrong).error().message, HasSubstr("and only those"));
  wrong.mutable_object(0)->mutable_point_asset()->set_numbers(5000);
  EXPECT_TRUE(FrameKey(wrong).ok());
  wrong.mutable_object(0)->mutable_point_asset()->set_digest("12");
  EXPECT_THAT(FrameKey(wrong).error().message, HasSubstr("is not a digest"));
  wrong.mutable_object(0)->mutable_point_asset()->set_digest(short_list->digest.Hex());
  wrong.mutable_object(0)->add_point(1);
  EXPECT_THAT(FrameKey(wrong).error().message, HasSubstr("written and named"));
}

TEST(FrameGeometryTest, WhatIsNotAtHandOrOfAnotherKindIsAnError) {
  AssetSet assets;
  const Result<v1::FrameScene> scene = Animate(Grid(40))->Inbetween(1, &assets);
  ASSERT_TRUE(scene.ok());
  v1::FrameObject object = scene->object(0);
  EXPECT_EQ(CoarseShapeOf(object, nullptr).error().code, ErrorCode::kNotFound);
  AssetSet none;
  EXPECT_EQ(CoarseShapeOf(object, &none).error().code, ErrorCode::kNotFound);
  *object.mutable_point_asset() = object.face_asset();
  EXPECT_THAT(CoarseShapeOf(object, &assets).error().message, HasSubstr("holds no points"));
  object = scene->object(0);
  object.mutable_point_asset()->set_numbers(5046);
  EXPECT_FALSE(CoarseShapeOf(object, &assets).ok());
  const SharedAsset bad =
      MakeAsset(FaceList{std::vector<uint32_t>(2000, 3), std::vector<uint32_t>(6000, 1681)});
  assets.Add(bad);
  object = scene->object(0);
  object.mutable_face_asset()->set_digest(bad->digest.Hex());
  object.mutable_face_asset()->set_numbers(8000);
  EXPECT_THAT(CoarseShapeOf(object, &assets).error().message,
              HasSubstr("names vertex 1682 of 1681"));
}

}  // namespace
}  // namespace fjord
