#include "engine/animation/motion.h"

#include <algorithm>

#include "engine/animation/travel.h"
#include "engine/scene/track.h"

namespace fjord {
namespace {

std::vector<Vec3> Controls(const v1::Path& path) {
  std::vector<Vec3> controls;
  for (const v1::Vec3& c : path.control()) controls.emplace_back(c.x(), c.y(), c.z());
  return controls;
}

Vec3 Mixed(const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; }

}  // namespace

Motion Motion::Make(const v1::Object& object, std::vector<Geometry> keys) {
  FJORD_CHECK(!keys.empty(), object.name());
  Motion motion;
  AlignedKeys aligned = AlignKeys(object, keys);
  motion.keys_ = std::move(aligned.points);
  for (int k = 0; k < object.key_size(); ++k) {
    motion.frames_.push_back(object.key(k).frame());
    motion.eases_.push_back(object.key(k).ease());
    if (object.key(k).frame() == object.rest_frame()) motion.rest_key_ = static_cast<size_t>(k);
  }
  for (size_t k = 0; k < keys.size() && !keys[k].colors.empty(); ++k) {
    std::vector<Rgb> colors(motion.keys_[k].size());
    for (size_t v = 0; v < keys[k].colors.size(); ++v) {
      colors[aligned.number_of[k][v]] = keys[k].colors[v];
    }
    motion.colors_.push_back(std::move(colors));
  }
  for (int p = 0; p < object.point_path_size(); ++p) {
    const v1::PointPath& path = object.point_path(p);
    const size_t key = path.key() - 1;
    motion.own_paths_[key].push_back({p, aligned.number_of[key][path.vertex() - 1]});
  }
  motion.topology_ = std::move(keys[0]);
  motion.topology_.points = motion.keys_[0];
  return motion;
}

Motion::Piece Motion::PieceAt(double frame) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), frame);
  if (after == frames_.begin()) return {0, 0};
  const auto key = static_cast<size_t>(after - frames_.begin()) - 1;
  if (after == frames_.end() || frames_[key] == frame) return {key, 0};
  return {key, Eased(eases_[key], (frame - frames_[key]) / (*after - frames_[key]))};
}

void Motion::Straight(const Piece& piece, std::vector<Vec3>* points) const {
  const std::vector<Vec3>& a = keys_[piece.key];
  const std::vector<Vec3>& b = keys_[piece.key + 1];
  points->resize(a.size());
  for (size_t i = 0; i < a.size(); ++i) (*points)[i] = Mixed(a[i], b[i], piece.t);
}

std::array<double, 4> Motion::Weights(const Piece& piece) const {
  const size_t k = piece.key;
  const bool before = k > 0, after = k + 2 < frames_.size();
  return SplineWeights(
      {before ? frames_[k - 1] : 0, frames_[k], frames_[k + 1], after ? frames_[k + 2] : 0}, before,
      after, piece.t);
}

Vec3 Motion::OnSpline(const Piece& piece, const std::array<double, 4>& weights,
                      size_t point) const {
  const size_t k = piece.key;
  Vec3 place = keys_[k][point] * weights[1] + keys_[k + 1][point] * weights[2];
  if (k > 0) place += keys_[k - 1][point] * weights[0];
  if (k + 2 < keys_.size()) place += keys_[k + 2][point] * weights[3];
  return place;
}

Vec3 Motion::OnOwnPath(const v1::Path& path, const Piece& piece, size_t point) const {
  const Vec3& a = keys_[piece.key][point];
  const Vec3& b = keys_[piece.key + 1][point];
  std::vector<Vec3> way = Controls(path);
  way.insert(way.begin(), a);
  way.push_back(b);
  switch (path.kind()) {
    case v1::Path::STEER:
      return Bezier(way, piece.t);
    case v1::Path::THROUGH:
      return Through(way, piece.t);
    case v1::Path::SPLINE:
      return OnSpline(piece, Weights(piece), point);
    default:
      return Mixed(a, b, piece.t);
  }
}

void Motion::PointsAt(const v1::Object& object, double frame, std::vector<Vec3>* points) const {
  const Piece piece = PieceAt(frame);
  if (piece.t == 0) {
    *points = keys_[piece.key];
    return;
  }
  Straight(piece, points);
  std::vector<Vec3> offsets = Controls(object.path());
  offsets.insert(offsets.begin(), Vec3(0));
  offsets.emplace_back(0);
  switch (object.path().kind()) {
    case v1::Path::STEER: {
      const Vec3 offset = Bezier(offsets, piece.t);
      for (Vec3& point : *points) point += offset;
      break;
    }
    case v1::Path::THROUGH: {
      const Vec3 offset = Through(offsets, piece.t);
      for (Vec3& point : *points) point += offset;
      break;
    }
    case v1::Path::SPLINE: {
      const std::array<double, 4> weights = Weights(piece);
      for (size_t i = 0; i < points->size(); ++i) (*points)[i] = OnSpline(piece, weights, i);
      break;
    }
    default:
      break;
  }
  const auto own = own_paths_.find(piece.key);
  if (own == own_paths_.end()) return;
  for (const OwnPath& path : own->second) {
    (*points)[path.point] = OnOwnPath(object.point_path(path.entry).path(), piece, path.point);
  }
}

std::vector<Rgb> Motion::ColorsAt(double frame) const {
  if (colors_.empty()) return {};
  const Piece piece = PieceAt(frame);
  std::vector<Rgb> colors = colors_[piece.key];
  for (size_t i = 0; i < colors.size() && piece.t != 0; ++i) {
    colors[i] += (colors_[piece.key + 1][i] - colors[i]) * static_cast<float>(piece.t);
  }
  return colors;
}

}  // namespace fjord
