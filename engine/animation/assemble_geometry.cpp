// The coarse shape of an object into a frame scene; frame_geometry.cpp reads it back.
#include <algorithm>

#include "engine/animation/frame_geometry.h"

namespace fjord {
namespace {

void Name(const SharedAsset& asset, v1::FrameAsset* message, AssetSet* assets) {
  message->set_digest(asset->digest.Hex());
  message->set_numbers(asset->numbers);
  if (assets != nullptr) assets->Add(asset);
}

}  // namespace

SharedAsset AssetOf(std::span<const Vec3> points) {
  if (3 * points.size() <= kInlineNumbers) return nullptr;
  return MakeAsset(PointList(points.begin(), points.end()));
}

SharedAsset AssetOf(std::span<const Rgb> colors) {
  if (3 * colors.size() <= kInlineNumbers) return nullptr;
  return MakeAsset(ColorList(colors.begin(), colors.end()));
}

SharedAsset AssetOf(const Geometry& topology) {
  if (topology.face_size.size() + topology.face_vertex.size() <= kInlineNumbers) return nullptr;
  return MakeAsset(FaceList{topology.face_size, topology.face_vertex});
}

SharedAsset AssetOf(const HeightSamples& samples) {
  if (uint64_t{samples->columns()} * samples->rows() <= kInlineNumbers) return nullptr;
  return MakeAsset(samples);
}

SharedAsset AssetOf(const PlacementList& placements) {
  if (12 * placements.size() <= kInlineNumbers) return nullptr;
  return MakeAsset(placements);
}

void AssembleHeights(const HeightsPose& pose, v1::FrameHeights* heights, AssetSet* assets) {
  const HeightSource& source = *pose.now.source;
  heights->set_columns(source.columns());
  heights->set_rows(source.rows());
  for (int i = 0; i < 3; ++i) heights->add_size(pose.now.size[i]);
  for (int i = 0; i < 3 && pose.rest_size != pose.now.size; ++i) {
    heights->add_rest_size(pose.rest_size[i]);
  }
  if (pose.flat) return;
  if (pose.samples_asset) {
    Name(pose.samples_asset, heights->mutable_sample_asset(), assets);
    return;
  }
  for (uint32_t j = 0; j < source.rows(); ++j) {
    for (uint32_t i = 0; i < source.columns(); ++i) heights->add_sample(double{source.At(i, j)});
  }
}

void AssemblePlacements(const PlacementList& placements, const SharedAsset& asset,
                        v1::FrameObject* object, AssetSet* assets) {
  if (asset) {
    Name(asset, object->mutable_placement_asset(), assets);
    return;
  }
  for (const Rows& rows : placements) object->mutable_placement()->Add(rows.begin(), rows.end());
}

void AssembleGeometry(const FramePose& pose, v1::FrameObject* object, AssetSet* assets) {
  const SharedAsset points = pose.points_asset ? pose.points_asset : AssetOf(pose.points);
  if (points) {
    Name(points, object->mutable_point_asset(), assets);
    const SharedAsset rest = pose.rest_asset ? pose.rest_asset : AssetOf(pose.rest);
    if (rest->digest != points->digest) Name(rest, object->mutable_rest_asset(), assets);
  } else {
    AppendTriples(pose.points, object->mutable_point());
    if (!std::equal(pose.points.begin(), pose.points.end(), pose.rest.begin(), pose.rest.end())) {
      AppendTriples(pose.rest, object->mutable_rest());
    }
  }
  const Geometry& topology = *pose.topology;
  const SharedAsset faces = pose.faces_asset ? pose.faces_asset : AssetOf(topology);
  if (faces) {
    Name(faces, object->mutable_face_asset(), assets);
  } else {
    object->mutable_face_size()->Add(topology.face_size.begin(), topology.face_size.end());
    object->mutable_face_vertex()->Add(topology.face_vertex.begin(), topology.face_vertex.end());
  }
  const SharedAsset colors = pose.colors_asset ? pose.colors_asset : AssetOf(pose.colors);
  if (colors) {
    Name(colors, object->mutable_color_asset(), assets);
  } else {
    AppendTriples(pose.colors, object->mutable_color());
  }
  object->set_curve(topology.curve);
  object->set_closed(topology.closed);
}

}  // namespace fjord
