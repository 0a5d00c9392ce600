// Numbers over time: easing, and the tracks of a scene (W2). Here, below the animation layer,
// because the default camera looks at where tracked transforms take the objects.
//
// T1 At a key's frame a track gives the key's values bit for bit.
// T2 Before the first key and after the last the value stays.
#pragma once

#include <vector>

#include "engine/scene/route.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// 0..1 to 0..1; 0 to 0 and 1 to 1, but HOLD gives 0 throughout.
double Eased(v1::Key::Ease ease, double t);

// The values of a track (its keys ascending, of one value count, at least one) at a frame.
std::vector<double> TrackValues(const v1::Track& track, double frame);

// The tracks of a checked scene with their routes. Immutable.
class TrackSet {
 public:
  TrackSet() = default;
  // Every path must resolve (validate_tracks.cpp).
  explicit TrackSet(const v1::Scene& scene);

  // Writes every track's values at `frame` into `scene`, which has the shape of the scene that the
  // set was made from (shapes may be left out where no track leads into them).
  void Apply(double frame, v1::Scene* scene) const;

  // Does any track write inside `route`, or to something that holds it?
  bool Touches(const Route& route) const;
  // The tracks that lead into each of `count` objects.
  std::vector<TrackSet> OfObjects(int count) const;
  // The tracks that Touches(one of the routes).
  TrackSet Inside(const std::vector<Route>& routes) const;

  // Outside first_frame()..last_frame() nothing changes. An empty set has both 1.
  double first_frame() const;
  double last_frame() const;
  bool empty() const { return entries_.empty(); }
  size_t size() const { return entries_.size(); }
  // The frames of all keys, ascending, each once. Between two of them every number that the tracks
  // write goes one way only.
  std::vector<double> KeyFrames() const;

 private:
  struct Entry {
    Route route;
    v1::Track track;
  };
  std::vector<Entry> entries_;
};

}  // namespace fjord
