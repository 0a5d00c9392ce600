#include "engine/animation/shot_fineness.h"

#include <algorithm>
#include <iterator>
#include <queue>
#include <utility>

#include "engine/animation/stretch.h"
#include "engine/animation/stretch_need.h"
#include "engine/base/clamp.h"

namespace fjord {
namespace {

// Frames or stretches looked at: of one object, and of all objects together about.
constexpr int kMostPieces = 4096;
constexpr int kLeastPieces = 64;
constexpr int kPiecesTogether = 400'000;

constexpr double kClose = 1.02;  // a bound this near to what is asked at a stretch's ends is kept
constexpr double kMatters = 4;   // so much coarser than the finest: not looked at any closer

double Magnitude(double x) { return x < 0 ? -x : x; }

// The frames of the whole shot in which a set of tracks changes anything.
Stretch MovingFrames(const TrackSet& tracks, uint32_t last) {
  const int64_t from = FloorToInt64(tracks.first_frame());
  const int64_t to = -FloorToInt64(-tracks.last_frame());
  return {static_cast<uint32_t>(std::clamp<int64_t>(from, 1, last)),
          static_cast<uint32_t>(std::clamp<int64_t>(to, 1, last))};
}

double LargestRatio(const ShotNumbers& numbers) {
  double least = 0, largest = 0;
  for (int i = 0; i < 3; ++i) {
    const double size = Magnitude(numbers.scale[i]);
    least = i == 0 ? size : std::min(least, size);
    largest = std::max(largest, size);
  }
  return least > 0 ? largest / least : 0;
}

struct Piece {
  Stretch frames;
  ShotNumbers at_first, at_last;
  FinenessNeed need;
  double asked = 0;  // about the least length that the need splits to
  bool close = true;

  // The finest need first; of equal ones the earlier, so that the order is one everywhere.
  friend bool operator<(const Piece& a, const Piece& b) {
    if (a.asked != b.asked) return a.asked > b.asked;
    return a.frames.first > b.frames.first;
  }
};

class ShotSearch {
 public:
  ShotSearch(const ShotObject& object, v1::Scene* scratch)
      : object_(object), scratch_(scratch), height_(scratch->output().height()) {
    const std::vector<double> own = object.own.KeyFrames(), camera = object.camera.KeyFrames();
    std::merge(own.begin(), own.end(), camera.begin(), camera.end(), std::back_inserter(keys_));
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    const Route scale = Route().Then("objects", object.index).Then("transform").Then("scale");
    one_scale_track_ = object.own.Inside({scale}).size() <= 1;
  }

  // What every single frame asks for.
  std::vector<FinenessNeed> OfFrames(const std::vector<uint32_t>& frames) {
    std::vector<FinenessNeed> needs;
    for (const uint32_t frame : frames) {
      At(frame);
      needs.push_back(NeedNow());
    }
    return needs;
  }

  std::vector<FinenessNeed> OfStretches(Stretch whole, size_t most,
                                        const std::atomic<bool>* cancel) {
    std::priority_queue<Piece> open;
    std::vector<FinenessNeed> closed;
    const auto keep = [&](Piece piece) {
      if (piece.close) {
        closed.push_back(piece.need);
      } else {
        open.push(std::move(piece));
      }
    };
    for (const Stretch& stretch : CutAtKeys(keys_, whole, most / 2)) {
      const ShotNumbers first = At(stretch.first);
      Ask(NeedNow());
      const ShotNumbers last = At(stretch.last);
      Ask(NeedNow());
      keep(MakePiece(stretch, first, last));
    }
    while (!open.empty() && open.size() + closed.size() < most &&
           !(open.top().asked > kMatters * finest_) &&
           (cancel == nullptr || !cancel->load(std::memory_order_relaxed))) {
      const Piece piece = open.top();
      open.pop();
      const uint32_t middle = piece.frames.first + (piece.frames.last - piece.frames.first) / 2;
      const ShotNumbers left = At(middle);
      Ask(NeedNow());
      const ShotNumbers right = At(middle + 1);
      Ask(NeedNow());
      keep(MakePiece({piece.frames.first, middle}, piece.at_first, left));
      keep(MakePiece({middle + 1, piece.frames.last}, right, piece.at_last));
    }
    for (; !open.empty(); open.pop()) closed.push_back(open.top().need);
    return closed;
  }

 private:
  ShotNumbers At(double frame) {
    object_.camera.Apply(frame, scratch_);
    object_.own.Apply(frame, scratch_);
    return ShotNumbers(*scratch_, object_.index);
  }

  // What the frame asks for that the scratch shows.
  FinenessNeed NeedNow() const {
    const v1::Object& object = scratch_->objects(object_.index);
    return NeedOf(
        {CameraState(scratch_->camera()), ObjectTransform(object.transform()),
         object.fractal().epsilon(), object.fractal().pixels(), object.fractal().viewing()},
        object_.rest, height_);
  }

  double AskedBy(const FinenessNeed& need) const {
    if (need.focal <= 0) return need.epsilon;
    const double distance = DistanceTo(object_.rest, need.eye.center) - need.eye.radius;
    return std::min(need.epsilon, need.pixels * std::max(need.near, distance) / need.focal);
  }

  void Ask(const FinenessNeed& need) {
    if (need.any && (finest_ == 0 || AskedBy(need) < finest_)) finest_ = AskedBy(need);
  }

  Piece MakePiece(const Stretch& frames, const ShotNumbers& first, const ShotNumbers& last) {
    Piece piece{frames, first, last, {}};
    Show(last, object_.index, scratch_);
    const FinenessNeed at_last = NeedNow();
    if (frames.first == frames.last) {
      piece.need = at_last;
      piece.asked = AskedBy(piece.need);
      return piece;
    }
    Show(first, object_.index, scratch_);
    const FinenessNeed at_first = NeedNow();
    ShotBounds bounds(first);
    bounds.Add(last);
    double ratio = std::max(LargestRatio(first), LargestRatio(last));
    for (const double key : KeysInside(keys_, frames)) {
      const ShotNumbers numbers = At(key);
      bounds.Add(numbers);
      ratio = std::max(ratio, LargestRatio(numbers));
    }
    // under one track the ratio of two sizes goes one way between keys, too
    piece.need =
        NeedBetween(bounds, one_scale_track_ ? ratio : 0, object_.rest, object_.index, scratch_);
    piece.asked = AskedBy(piece.need);
    Judge(at_first, at_last, &piece);
    return piece;
  }

  // Is the bound close to what the ends ask for?
  void Judge(const FinenessNeed& first, const FinenessNeed& last, Piece* piece) const {
    const FinenessNeed& need = piece->need;
    if (!need.any) return;
    const auto exact = [](bool a_counts, double a, bool b_counts, double b, bool least) {
      if (!a_counts || !b_counts) return a_counts ? a : b;
      return least ? std::min(a, b) : std::max(a, b);
    };
    const double epsilon = exact(first.any, first.epsilon, last.any, last.epsilon, true);
    piece->close = epsilon <= need.epsilon * kClose;
    const bool formless = need.focal <= 0 && (first.focal > 0 || last.focal > 0);
    if (formless || need.focal > kClose * std::max(first.focal, last.focal)) {
      piece->close = false;
      piece->asked = 0;  // would spoil the whole shot
    } else if (need.focal > 0) {
      const double distance = DistanceTo(object_.rest, need.eye.center) - need.eye.radius;
      piece->close =
          piece->close && need.eye.radius <= (kClose - 1) * std::max(need.near, distance);
    }
  }

  const ShotObject& object_;
  v1::Scene* const scratch_;
  const uint32_t height_;
  std::vector<double> keys_;
  bool one_scale_track_ = true;
  double finest_ = 0;  // asked by any frame looked at so far
};

// Cells for bounding the eye, so that many objects over many frames stay affordable.
int CellsAlong(size_t needs, int objects) {
  const uint64_t work = uint64_t{needs} * static_cast<uint64_t>(objects);
  return work <= 5'000 ? 8 : work <= 100'000 ? 4 : work <= 1'000'000 ? 2 : 1;
}

}  // namespace

v1::FrameFineness FinenessOverShot(const ShotObject& object, v1::Scene* scratch,
                                   const std::atomic<bool>* cancel) {
  const uint32_t last = scratch->output().frames();
  const Stretch own = MovingFrames(object.own, last), camera = MovingFrames(object.camera, last);
  const bool own_moves = !object.own.empty();
  const bool camera_moves = camera.first < camera.last;
  Stretch whole = own_moves ? own : camera;
  if (own_moves && camera_moves) {
    whole = {std::min(own.first, camera.first), std::max(own.last, camera.last)};
  }
  const auto most =
      static_cast<size_t>(std::clamp(kPiecesTogether / object.objects, kLeastPieces, kMostPieces));
  ShotSearch search(object, scratch);
  std::vector<FinenessNeed> needs;
  if (whole.last - whole.first < most) {
    std::vector<uint32_t> frames;
    for (uint32_t frame = whole.first; frame <= whole.last; ++frame) {
      const auto within = [&](const Stretch& s) { return frame >= s.first && frame <= s.last; };
      if (!own_moves || within(own) || (camera_moves && within(camera))) frames.push_back(frame);
    }
    needs = search.OfFrames(frames);
  } else {
    needs = search.OfStretches(whole, most, cancel);
  }
  return FinenessFor(needs, object.rest, CellsAlong(needs.size(), object.objects));
}

}  // namespace fjord
