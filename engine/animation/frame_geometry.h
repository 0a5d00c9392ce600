// The coarse shape of an object in a frame scene: short lists stand in the message, long ones are
// named by the digest of their samples and come from an AssetResolver.
//
// Invariants
// G1 One rule decides: a list of more than kInlineNumbers numbers is named, a shorter one stands in
//    the message. So equal shapes have one form and one frame key, on every machine.
// G2 Faces are cut into triangles by the rest pose: every frame of a shot has the same triangles.
#pragma once

#include <span>

#include "engine/asset/asset.h"
#include "engine/base/result.h"
#include "engine/fractal/method.h"
#include "engine/scene/shapes.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

inline constexpr uint64_t kInlineNumbers = 4096;

// What the coarse shape of an object is in one frame. Where an asset is there, its list is long and
// the span beside it need not be looked at.
struct FramePose {
  const Geometry* topology = nullptr;  // faces, kind
  std::span<const Vec3> points;
  std::span<const Vec3> rest;
  std::span<const Rgb> colors;
  SharedAsset points_asset, rest_asset, faces_asset, colors_asset;
};

// A height field in one frame. Without `samples_asset` the samples are short, or all 0 where
// `flat`.
struct HeightsPose {
  HeightField now;
  Vec3 rest_size{0};
  bool flat = false;
  SharedAsset samples_asset;
};

// Points or colours as three numbers each.
template <typename List>
void AppendTriples(const List& list, google::protobuf::RepeatedField<double>* values) {
  values->Reserve(values->size() + static_cast<int>(3 * list.size()));
  for (const auto& item : list) {
    for (int i = 0; i < 3; ++i) values->AddAlreadyReserved(item[i]);
  }
}

// The asset of a list that is long, else null.
SharedAsset AssetOf(std::span<const Vec3> points);
SharedAsset AssetOf(std::span<const Rgb> colors);
SharedAsset AssetOf(const Geometry& topology);
SharedAsset AssetOf(const HeightSamples& samples);
SharedAsset AssetOf(const PlacementList& placements);

// Writes the shape. `assets`, where it is not null, gets the lists that are only named.
void AssembleGeometry(const FramePose& pose, v1::FrameObject* object, AssetSet* assets);

// All but the fineness.
void AssembleHeights(const HeightsPose& pose, v1::FrameHeights* heights, AssetSet* assets);
// `asset`: of the placements, where they are many.
void AssemblePlacements(const PlacementList& placements, const SharedAsset& asset,
                        v1::FrameObject* object, AssetSet* assets);

// Points, rest pose, colours and, as `takes` says, triangles or faces; or heights. kInvalid where
// the message is inconsistent (indices, counts, digests), kNotFound where a list is not at hand.
// `assets` may be null where none is named.
Result<CoarseShape> CoarseShapeOf(const v1::FrameObject& object, const AssetResolver* assets,
                                  Takes takes = Takes::kTriangles);

// One map for each placement, finite; none where the object is drawn once.
Result<PlacementList> PlacementsOf(const v1::FrameObject& object, const AssetResolver* assets);

// The object with its long lists written out, for those who change points.
Result<v1::FrameObject> WrittenOut(const v1::FrameObject& object, const AssetResolver* assets);

// G1; what a frame key relies on.
Result<> CheckGeometryForm(const v1::FrameObject& object);

}  // namespace fjord
