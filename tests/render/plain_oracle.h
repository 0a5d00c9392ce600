// A frame drawn the plain way: everything is made, nothing is left out as hidden or beside the
// tile, and there is one tile. What every other way of drawing must equal.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/render/build.h"
#include "engine/render/tiles.h"
#include "gtest/gtest.h"

namespace fjord {

// Streams everything, whatever the sink wants.
class Unculled final : public PreparedFractal {
 public:
  explicit Unculled(std::shared_ptr<const PreparedFractal> inner) : inner_(std::move(inner)) {}
  size_t RootCount() const override { return inner_->RootCount(); }
  Triangle Corners(uint32_t element) const override { return inner_->Corners(element); }
  Ball Bound(size_t) const override { return {Vec3(0), 1e6}; }
  StreamStats Stream(size_t root, StreamSink& sink, size_t patch) const override {
    class All final : public StreamSink {
     public:
      explicit All(StreamSink* sink) : sink_(sink) {}
      bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override {
        return true;
      }
      void Take(const StreamBatch& batch) override { sink_->Take(batch); }
      bool ReadsPlaces() const override { return sink_->ReadsPlaces(); }

     private:
      StreamSink* sink_;
    };
    All all(&sink);
    return inner_->Stream(root, all, patch);
  }
  Result<WeldedShape> Weld(const WeldLimits& limits) const override { return inner_->Weld(limits); }
  size_t Bytes() const override { return inner_->Bytes(); }

 private:
  std::shared_ptr<const PreparedFractal> inner_;
};

inline BuiltFrame Unhidden(BuiltFrame frame) {
  for (BuiltObject& object : frame.objects) {
    object.prepared = std::make_shared<Unculled>(object.prepared);
  }
  return frame;
}

inline TileRect WholeOf(const BuiltFrame& frame) {
  return {0, 0, static_cast<int32_t>(frame.width), static_cast<int32_t>(frame.height)};
}

inline RenderedFrame DrawBuilt(const BuiltFrame& frame, const RenderOptions& options) {
  Result<RenderedFrame> drawn = RenderRegion(frame, WholeOf(frame), options);
  EXPECT_TRUE(drawn.ok());
  return drawn.ok() ? std::move(*drawn) : RenderedFrame{};
}

// At most 4096 pixels wide and high.
inline RenderedFrame DrawPlain(const BuiltFrame& frame) {
  return DrawBuilt(Unhidden(frame), {.threads = 1, .tile_size = 4096});
}

}  // namespace fjord
