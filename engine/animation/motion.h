// How the coarse points of one object move over the shot. Immutable once made; safe to share.
//
// M1 At a key's frame the points are the key's bit for bit; before the first key and after the last
//    they are that key's.
// M2 The number of points, and the faces, never change.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "engine/animation/correspondence.h"
#include "engine/scene/shapes.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

class Motion {
 public:
  // One geometry for each key, or the object's only shape.
  static Motion Make(const v1::Object& object, std::vector<Geometry> keys);

  // Faces and kind; its points and colours are the first key's.
  const Geometry& topology() const { return topology_; }
  const std::vector<Vec3>& rest() const { return keys_[rest_key_]; }

  // `object` for the control points of paths, which tracks may move.
  void PointsAt(const v1::Object& object, double frame, std::vector<Vec3>* points) const;
  std::vector<Rgb> ColorsAt(double frame) const;  // empty: none

 private:
  struct Piece {
    size_t key;  // the key that it starts at
    double t;    // eased, 0..1; 0 at the key and past the last
  };
  Piece PieceAt(double frame) const;
  void Straight(const Piece& piece, std::vector<Vec3>* points) const;
  std::array<double, 4> Weights(const Piece& piece) const;
  Vec3 OnSpline(const Piece& piece, const std::array<double, 4>& weights, size_t point) const;
  Vec3 OnOwnPath(const v1::Path& path, const Piece& piece, size_t point) const;

  Geometry topology_;
  std::vector<std::vector<Vec3>> keys_;
  std::vector<std::vector<Rgb>> colors_;  // empty, or one list a key
  std::vector<double> frames_;
  std::vector<v1::Key::Ease> eases_;
  size_t rest_key_ = 0;
  struct OwnPath {
    int entry;  // of Object.point_path
    size_t point;
  };
  std::map<size_t, std::vector<OwnPath>> own_paths_;  // by the key that the piece starts at
};

}  // namespace fjord
