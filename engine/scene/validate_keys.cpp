// CheckKeys of validate.h: key pictures, how their points correspond, and paths.
#include <algorithm>
#include <numeric>
#include <set>

#include "engine/scene/limits.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

std::string KeyName(const v1::Object& object, int key) {
  return "key " + std::to_string(key + 1) + " (frame " + std::to_string(object.key(key).frame()) +
         ")";
}

void CheckFrames(const v1::Object& object, const Route& route, SceneErrors* errors) {
  for (int k = 0; k < object.key_size(); ++k) {
    const v1::Key& key = object.key(k);
    const Route place = route.Then("key", k);
    const bool follows = k > 0 && !errors->Refused(route.Then("key", k - 1).Then("frame"));
    if (!key.has_frame()) {
      errors->Add(place, "frame is missing");
    } else if (follows && key.frame() == object.key(k - 1).frame()) {
      errors->Add(place.Then("frame"), "two keys at frame " + std::to_string(key.frame()));
    } else if (follows && key.frame() < object.key(k - 1).frame()) {
      errors->Add(place.Then("frame"),
                  "frame " + std::to_string(key.frame()) + " comes after frame " +
                      std::to_string(object.key(k - 1).frame()) + "; keys ascend");
    }
    if (!key.has_shape()) errors->Add(place, "shape is missing");
  }
}

void CheckRestFrame(const v1::Object& object, const Route& route, SceneErrors* errors) {
  if (!object.has_rest_frame()) return;
  for (const v1::Key& key : object.key()) {
    if (key.frame() == object.rest_frame()) return;
  }
  errors->Add(route.Then("rest_frame"),
              object.key_size() == 0
                  ? "there are no keys; the rest pose is the shape itself"
                  : "there is no key at frame " + std::to_string(object.rest_frame()));
}

// The kind of one way to travel.
void CheckPath(const v1::Path& path, int keys, const Route& route, SceneErrors* errors) {
  const bool controlled = path.kind() == v1::Path::STEER || path.kind() == v1::Path::THROUGH;
  const std::string name = v1::Path::Kind_Name(path.kind());
  if (controlled && path.control_size() == 0) {
    errors->Add(route, "kind " + name + " needs control points; add control { x: 0 y: 0 z: 1 }");
  }
  if (!controlled && path.control_size() > 0) {
    errors->Add(route, "kind " + name + " has no control points; use STEER or THROUGH");
  }
  if (path.kind() == v1::Path::SPLINE && keys < 3) {
    errors->Add(route.Then("kind"),
                "SPLINE needs three keys or more; there are " + std::to_string(keys));
  }
}

void CheckPaths(const v1::Object& object, const Route& route, const SceneShapes& shapes, int index,
                SceneErrors* errors) {
  if (object.key_size() < 2) {
    if (object.has_path())
      errors->Add(route.Then("path"), "there are no two keys to travel between");
    if (object.point_path_size() > 0) {
      errors->Add(route.Then("point_path", 0), "there are no two keys to travel between");
    }
    return;
  }
  CheckPath(object.path(), object.key_size(), route.Then("path"), errors);
  std::set<std::pair<uint32_t, uint32_t>> seen;
  for (int p = 0; p < object.point_path_size(); ++p) {
    const v1::PointPath& path = object.point_path(p);
    const Route place = route.Then("point_path", p);
    CheckPath(path.path(), object.key_size(), place.Then("path"), errors);
    if (path.key() < 1 || path.key() >= static_cast<uint32_t>(object.key_size())) {
      errors->Add(place.Then("key"), "no piece starts at key " + std::to_string(path.key()) +
                                         "; pieces start at keys 1 to " +
                                         std::to_string(object.key_size() - 1));
      continue;
    }
    const auto& geometry = shapes.of[static_cast<size_t>(index)][path.key() - 1];
    const size_t count = geometry ? geometry->points.size() : SIZE_MAX;
    if (path.vertex() < 1 || path.vertex() > count) {
      errors->Add(place.Then("vertex"), "there is no vertex " + std::to_string(path.vertex()) +
                                            "; key " + std::to_string(path.key()) +
                                            " has vertices 1 to " + std::to_string(count));
    }
    if (!seen.emplace(path.key(), path.vertex()).second) {
      errors->Add(place.Then("vertex"),
                  "vertex " + std::to_string(path.vertex()) + " has a path already");
    }
  }
}

// Pairs of one key with the key before: in range, each point once, outlines in order. False where
// they are not.
bool CheckPairs(const v1::Object& object, int k, const Geometry& before, const Geometry& now,
                const Route& route, SceneErrors* errors) {
  const v1::Key& key = object.key(k);
  std::vector<bool> from_used(before.points.size() + 1), to_used(now.points.size() + 1);
  bool sound = true;
  const auto check = [&](uint32_t number, size_t count, std::vector<bool>* used, const Route& place,
                         int which) {
    if (number < 1 || number > count) {
      errors->Add(place, "there is no vertex " + std::to_string(number) + "; " +
                             KeyName(object, which) + " has vertices 1 to " +
                             std::to_string(count));
      sound = false;
    } else if ((*used)[number]) {
      errors->Add(place, "vertex " + std::to_string(number) + " is paired twice");
      sound = false;
    } else {
      (*used)[number] = true;
    }
  };
  for (int p = 0; p < key.pair_size(); ++p) {
    const Route place = route.Then("pair", p);
    check(key.pair(p).from(), before.points.size(), &from_used, place.Then("from"), k - 1);
    check(key.pair(p).to(), now.points.size(), &to_used, place.Then("to"), k);
  }
  if (!sound) return false;
  if (!now.curve) {
    for (size_t v = 1; v <= before.points.size(); ++v) {
      if (from_used[v]) continue;
      errors->Add(route, "vertex " + std::to_string(v) + " of " + KeyName(object, k - 1) +
                             " has no pair; meshes need a pair for every vertex");
      return false;
    }
    return true;
  }
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (const v1::Pair& pair : key.pair()) pairs.emplace_back(pair.from(), pair.to());
  std::sort(pairs.begin(), pairs.end());
  int descents = 0;
  uint32_t culprit = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const bool last = i + 1 == pairs.size();
    if (last && !now.closed) break;
    if (pairs[last ? 0 : i + 1].second < pairs[i].second) {
      ++descents;
      culprit = pairs[i].first;
    }
  }
  if (descents <= (now.closed ? 1 : 0)) return true;
  errors->Add(route, "the pairs cross near vertex " + std::to_string(culprit) +
                         ": along an outline both sides must run in the same order");
  return false;
}

// The keys of a mesh join the same vertices to the same faces. Pairs are sound.
void CheckFaces(const v1::Object& object, int k, const Geometry& before, const Geometry& now,
                const Route& route, SceneErrors* errors) {
  std::vector<uint32_t> number_of(now.points.size());
  std::iota(number_of.begin(), number_of.end(), 0u);
  if (object.correspondence() == v1::BY_PAIRS) {
    for (const v1::Pair& pair : object.key(k).pair()) number_of[pair.to() - 1] = pair.from() - 1;
  }
  const std::string difference = FaceDifference(before, now, number_of);
  if (difference.empty()) return;
  errors->Add(route.Then("shape"),
              "other faces than " + KeyName(object, k - 1) + ": it " + difference +
                  " (vertices as numbered there); move the vertices and leave the faces, or say "
                  "by pairs which vertex becomes which (correspondence: BY_PAIRS)");
}

void CheckCorrespondence(const v1::Object& object, int k, const Geometry& before,
                         const Geometry& now, const Route& route, SceneErrors* errors) {
  const std::string names = KeyName(object, k - 1) + " and " + KeyName(object, k);
  if (before.curve != now.curve || before.closed != now.closed) {
    errors->Add(route.Then("shape"),
                names + " are of different kinds: " +
                    (before.curve ? before.closed ? "a closed curve" : "an open curve" : "a mesh") +
                    " and " +
                    (now.curve ? now.closed ? "a closed curve" : "an open curve" : "a mesh"));
    return;
  }
  if (before.colors.empty() != now.colors.empty()) {
    errors->Add(route.Then("shape"), names + ": one has colours and the other has not");
  }
  const size_t from = before.points.size(), to = now.points.size();
  const bool by_index = object.correspondence() == v1::BY_INDEX;
  if (from != to && (by_index || !now.curve)) {
    errors->Add(route.Then("shape"), names + " have " + std::to_string(from) + " and " +
                                         std::to_string(to) + " points; " +
                                         (now.curve ? "say correspondence: COMPUTED or BY_PAIRS"
                                                    : "the keys of a mesh need equally many"));
    return;
  }
  const bool sound =
      object.correspondence() != v1::BY_PAIRS || CheckPairs(object, k, before, now, route, errors);
  if (sound && !now.curve) CheckFaces(object, k, before, now, route, errors);
  if (object.key(k).pair_size() > 0 && object.correspondence() != v1::BY_PAIRS) {
    errors->Add(route.Then("pair", 0), "pairs need correspondence: BY_PAIRS");
  }
}

}  // namespace

void CheckKeys(const v1::Scene& scene, int index, const SceneShapes& shapes, SceneErrors* errors) {
  const v1::Object& object = scene.objects(index);
  const Route route = Route().Then("objects", index);
  CheckFrames(object, route, errors);
  CheckRestFrame(object, route, errors);
  if (object.has_shape()) {
    CheckPaths(object, route, shapes, index, errors);
    return;
  }
  const auto& geometries = shapes.of[static_cast<size_t>(index)];
  if (object.key_size() > 0 && object.key(0).pair_size() > 0) {
    errors->Add(route.Then("key", 0).Then("pair", 0), "there is no key before the first");
  }
  bool read = true;
  for (const auto& geometry : geometries) read = read && geometry.has_value();
  if (!read) return;
  if (object.correspondence() == v1::COMPUTED && !geometries.empty() && !geometries[0]->curve) {
    errors->Add(route.Then("correspondence"),
                "COMPUTED is for outlines; pair the points of meshes BY_INDEX or BY_PAIRS");
    return;
  }
  for (size_t k = 1; k < geometries.size(); ++k) {
    CheckCorrespondence(object, static_cast<int>(k), *geometries[k - 1], *geometries[k],
                        route.Then("key", static_cast<int>(k)), errors);
  }
  CheckPaths(object, route, shapes, index, errors);
}

}  // namespace fjord
