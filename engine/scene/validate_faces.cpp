// FaceDifference of validate.h.
#include <algorithm>
#include <iterator>
#include <numeric>

#include "engine/scene/validate.h"

namespace fjord {
namespace {

using Faces = std::vector<std::vector<uint32_t>>;

// Each face turned to its smallest vertex, the faces sorted.
Faces SortedFaces(const Geometry& mesh, std::span<const uint32_t> number_of) {
  Faces faces;
  size_t corner = 0;
  for (const uint32_t size : mesh.face_size) {
    std::vector<uint32_t> face;
    for (uint32_t i = 0; i < size; ++i) face.push_back(number_of[mesh.face_vertex[corner + i]]);
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(std::move(face));
    corner += size;
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// Those that `others` have not.
Faces Missing(const Faces& faces, const Faces& others) {
  Faces missing;
  std::set_difference(faces.begin(), faces.end(), others.begin(), others.end(),
                      std::back_inserter(missing));
  return missing;
}

std::string FaceText(const std::vector<uint32_t>& face) {
  std::string text = "the face";
  for (const uint32_t vertex : face) text.append(" ").append(std::to_string(vertex + 1));
  return text;
}

}  // namespace

std::string FaceDifference(const Geometry& before, const Geometry& now,
                           std::span<const uint32_t> number_of) {
  std::vector<uint32_t> same(before.points.size());
  std::iota(same.begin(), same.end(), 0u);
  if (std::equal(same.begin(), same.end(), number_of.begin(), number_of.end()) &&
      before.face_size == now.face_size && before.face_vertex == now.face_vertex) {
    return "";
  }
  const Faces first = SortedFaces(before, same), second = SortedFaces(now, number_of);
  const Faces lost = Missing(first, second), gained = Missing(second, first);
  if (lost.empty() && gained.empty()) return "";
  std::string text = lost.empty() ? "" : "lacks " + FaceText(lost[0]);
  if (!gained.empty()) text += (text.empty() ? "has " : " and has ") + FaceText(gained[0]);
  const size_t more =
      lost.size() + gained.size() - (lost.empty() ? 0 : 1) - (gained.empty() ? 0 : 1);
  if (more > 0) text += ", and " + std::to_string(more) + " faces more differ";
  return text;
}

}  // namespace fjord
