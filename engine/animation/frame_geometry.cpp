#include "engine/animation/frame_geometry.h"

#include <string>
#include <utility>

#include "engine/geometry/triangulate.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

Error Inconsistent(const std::string& what) { return Invalid("frame scene: " + what); }

Vec3 VectorAt(const Doubles& values, size_t i) {
  const int at = static_cast<int>(3 * i);
  return {values[at], values[at + 1], values[at + 2]};
}

Result<SharedAsset> Resolve(const v1::FrameAsset& named, const AssetResolver* assets) {
  const std::optional<Digest> digest = ParseDigest(named.digest());
  if (!digest) return Inconsistent("\"" + named.digest() + "\" is not a digest");
  if (assets == nullptr) {
    return MakeError(ErrorCode::kNotFound,
                     "frame scene: no assets are at hand for digest " + named.digest());
  }
  return assets->Find(*digest);
}

// One list, from where it is. `written` becomes a list of the right type.
template <typename List, typename Written>
Result<List> ListOf(const v1::FrameAsset* named, const AssetResolver* assets, const char* what,
                    const Written& written) {
  if (named == nullptr) return written();
  Result<SharedAsset> asset = Resolve(*named, assets);
  if (!asset) return asset.error();
  const List* list = std::get_if<List>(&(*asset)->data);
  if (list == nullptr || (*asset)->numbers != named->numbers()) {
    return Inconsistent("the list with digest " + named->digest() + " holds no " + what +
                        ", or another number of them");
  }
  return *list;
}

template <typename List>
Result<List> TriplesOf(const Doubles& values, const v1::FrameAsset* named,
                       const AssetResolver* assets, const char* what) {
  return ListOf<List>(named, assets, what, [&]() -> Result<List> {
    if (values.size() % 3 != 0) {
      return Inconsistent(std::string("an object's ") + what + " need three numbers each");
    }
    List list;
    list.reserve(static_cast<size_t>(values.size()) / 3);
    for (size_t i = 0; 3 * i < static_cast<size_t>(values.size()); ++i) {
      list.emplace_back(VectorAt(values, i));
    }
    return list;
  });
}

const v1::FrameAsset* If(bool there, const v1::FrameAsset& asset) {
  return there ? &asset : nullptr;
}

Result<FaceList> FacesOf(const v1::FrameObject& object, const AssetResolver* assets) {
  return ListOf<FaceList>(
      If(object.has_face_asset(), object.face_asset()), assets, "faces", [&]() -> Result<FaceList> {
        return FaceList{{object.face_size().begin(), object.face_size().end()},
                        {object.face_vertex().begin(), object.face_vertex().end()}};
      });
}

struct Lists {
  PointList points;
  PointList rest;  // empty: as points
  ColorList colors;
  FaceList faces;
};

Result<Lists> ListsOf(const v1::FrameObject& object, const AssetResolver* assets) {
  auto points = TriplesOf<PointList>(
      object.point(), If(object.has_point_asset(), object.point_asset()), assets, "points");
  if (!points) return points.error();
  auto rest = TriplesOf<PointList>(object.rest(), If(object.has_rest_asset(), object.rest_asset()),
                                   assets, "rest points");
  if (!rest) return rest.error();
  auto colors = TriplesOf<ColorList>(
      object.color(), If(object.has_color_asset(), object.color_asset()), assets, "colours");
  if (!colors) return colors.error();
  auto faces = FacesOf(object, assets);
  if (!faces) return faces.error();
  const size_t count = points->size();
  if ((!rest->empty() && rest->size() != count) || (!colors->empty() && colors->size() != count)) {
    return Inconsistent("an object's points, rest pose and colours differ in number");
  }
  return Lists{std::move(*points), std::move(*rest), std::move(*colors), std::move(*faces)};
}

Result<CoarseShape> HeightsOf(const v1::FrameHeights& heights, const AssetResolver* assets) {
  constexpr uint32_t kMost = uint32_t{1} << 20;
  const uint32_t columns = heights.columns(), rows = heights.rows();
  if (columns < 2 || rows < 2 || columns > kMost || rows > kMost) {
    return Inconsistent("heights of " + std::to_string(columns) + " x " + std::to_string(rows) +
                        " samples");
  }
  if (heights.size_size() != 3 ||
      (heights.rest_size_size() != 0 && heights.rest_size_size() != 3)) {
    return Inconsistent("the size of heights needs three numbers");
  }
  CoarseShape shape;
  HeightField& field = shape.heights.emplace();
  field.size = VectorAt(heights.size(), 0);
  shape.heights_rest = heights.rest_size_size() > 0 ? VectorAt(heights.rest_size(), 0) : field.size;
  for (const Vec3& size : {field.size, shape.heights_rest}) {
    if (!(size.x > 0 && size.x <= 1e15 && size.y > 0 && size.y <= 1e15 && size.z >= -1e15 &&
          size.z <= 1e15)) {
      return Inconsistent("the size of heights must be above 0 along x and y, and below 1e15");
    }
  }
  const uint64_t count = uint64_t{columns} * rows;
  if (heights.has_sample_asset()) {
    auto samples = ListOf<HeightSamples>(&heights.sample_asset(), assets, "heights",
                                         []() -> Result<HeightSamples> { return Invalid(""); });
    if (!samples) return samples.error();
    field.source = *samples;
  } else if (heights.sample_size() > 0) {
    if (static_cast<uint64_t>(heights.sample_size()) != count) {
      return Inconsistent("heights have another number of samples than columns and rows say");
    }
    std::vector<float> samples;
    for (const double sample : heights.sample()) {
      if (!(sample >= -1e15 && sample <= 1e15)) return Inconsistent("heights must be finite");
      samples.push_back(static_cast<float>(sample));
    }
    field.source = SampledHeights(columns, rows, std::move(samples));
  } else {
    field.source = FlatHeights(columns, rows);
  }
  if (field.source->columns() != columns || field.source->rows() != rows) {
    return Inconsistent("heights have other columns and rows than their samples");
  }
  return shape;
}

Result<> CheckFaces(const FaceList& faces, size_t points) {
  uint64_t corners = 0;
  for (const uint32_t size : faces.size) corners += size;
  if (corners != faces.vertex.size()) {
    return Inconsistent("an object's face sizes do not add up to its face vertices");
  }
  for (const uint32_t vertex : faces.vertex) {
    if (vertex >= points) {
      return Inconsistent("a face names vertex " + std::to_string(vertex + uint64_t{1}) + " of " +
                          std::to_string(points));
    }
  }
  return {};
}

}  // namespace

Result<PlacementList> PlacementsOf(const v1::FrameObject& object, const AssetResolver* assets) {
  auto placements = ListOf<PlacementList>(
      If(object.has_placement_asset(), object.placement_asset()), assets, "placements",
      [&]() -> Result<PlacementList> {
        if (object.placement_size() % 12 != 0) {
          return Inconsistent("a placement needs 12 numbers");
        }
        PlacementList list(static_cast<size_t>(object.placement_size()) / 12);
        for (int i = 0; i < object.placement_size(); ++i) {
          list[static_cast<size_t>(i) / 12][static_cast<size_t>(i) % 12] = object.placement(i);
        }
        return list;
      });
  if (!placements) return placements.error();
  for (const Rows& rows : *placements) {
    for (const double number : rows) {
      if (!(number >= -1e15 && number <= 1e15)) {
        return Inconsistent("placements must be finite and below 1e15");
      }
    }
  }
  return placements;
}

Result<CoarseShape> CoarseShapeOf(const v1::FrameObject& object, const AssetResolver* assets,
                                  Takes takes) {
  if (object.has_heights()) return HeightsOf(object.heights(), assets);
  Result<Lists> lists = ListsOf(object, assets);
  if (!lists) return lists.error();
  CoarseShape shape;
  shape.now = std::move(lists->points);
  shape.rest = lists->rest.empty() ? shape.now : std::move(lists->rest);
  shape.colors = std::move(lists->colors);
  shape.curve = object.curve();
  shape.closed = object.closed();
  if (shape.curve) return shape;
  if (Result<> sound = CheckFaces(lists->faces, shape.now.size()); !sound) return sound.error();
  if (takes == Takes::kFaces) {
    shape.face_size = std::move(lists->faces.size);
    shape.face_vertex = std::move(lists->faces.vertex);
    return shape;
  }
  shape.triangles = Triangulate(shape.rest, lists->faces.size, lists->faces.vertex);
  return shape;
}

Result<v1::FrameObject> WrittenOut(const v1::FrameObject& object, const AssetResolver* assets) {
  Result<Lists> lists = ListsOf(object, assets);
  if (!lists) return lists.error();
  v1::FrameObject out = object;
  for (Doubles* list : {out.mutable_point(), out.mutable_rest(), out.mutable_color()}) {
    list->Clear();
  }
  out.clear_point_asset();
  out.clear_rest_asset();
  out.clear_color_asset();
  out.clear_face_asset();
  AppendTriples(lists->points, out.mutable_point());
  AppendTriples(lists->rest, out.mutable_rest());
  AppendTriples(lists->colors, out.mutable_color());
  *out.mutable_face_size() = {lists->faces.size.begin(), lists->faces.size.end()};
  *out.mutable_face_vertex() = {lists->faces.vertex.begin(), lists->faces.vertex.end()};
  return out;
}

Result<> CheckGeometryForm(const v1::FrameObject& object) {
  const auto check = [](uint64_t written, bool named, const v1::FrameAsset& asset,
                        const char* what) -> Result<> {
    if (named && written > 0) return Inconsistent(std::string(what) + " are written and named");
    if (named && !IsDigestHex(asset.digest())) {
      return Inconsistent("\"" + asset.digest() + "\" is not a digest");
    }
    if ((named && asset.numbers() <= kInlineNumbers) || written > kInlineNumbers) {
      return Inconsistent(std::string(what) + " of more than " + std::to_string(kInlineNumbers) +
                          " numbers are named by digest, and only those");
    }
    return {};
  };
  const auto size = [](const auto& list) { return static_cast<uint64_t>(list.size()); };
  Result<> sound =
      check(size(object.point()), object.has_point_asset(), object.point_asset(), "points");
  if (sound) {
    sound = check(size(object.rest()), object.has_rest_asset(), object.rest_asset(), "rest points");
  }
  if (sound) {
    sound = check(size(object.color()), object.has_color_asset(), object.color_asset(), "colours");
  }
  if (sound) {
    sound = check(size(object.face_size()) + size(object.face_vertex()), object.has_face_asset(),
                  object.face_asset(), "faces");
  }
  if (sound) {
    sound = check(size(object.heights().sample()), object.heights().has_sample_asset(),
                  object.heights().sample_asset(), "heights");
  }
  if (sound) {
    sound = check(size(object.placement()), object.has_placement_asset(), object.placement_asset(),
                  "placements");
  }
  return sound;
}

}  // namespace fjord
