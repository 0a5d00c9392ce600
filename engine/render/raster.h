// Draws into the visibility buffer of one tile (W38, C24): triangles of any size and strokes. Fixed
// point, top-left rule: a sample on an edge shared by two triangles belongs to exactly one. Both
// sides of a triangle are drawn.
//
// Not for sharing between threads.
#pragma once

#include <array>
#include <cstdint>

#include "engine/fractal/method.h"
#include "engine/render/coverage.h"
#include "engine/render/micro_records.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/view.h"

namespace fjord {

// What is kept of the triangles that win a sample.
enum class Keep : uint8_t {
  kDepth,    // nothing: record 0 of the tile stands for all of them
  kRecords,  // facet normal and object
  kPlaces,   // also where the sample lies in its coarse element
};

// One corner on its way to the picture.
struct Corner {
  ScreenPoint screen;
  Vec3 position{0};  // object space
  Weights place{0};
};

class Raster {
 public:
  explicit Raster(TileBuffer* tile) : tile_(tile) {}

  // What follows belongs to this object.
  void StartObject(uint32_t object, const Projection& to, Keep keep, double line_width);

  // All triangles and segments of a batch.
  void Draw(const StreamBatch& batch);

  const TileBuffer& tile() const { return *tile_; }
  const Projection& projection() const { return to_; }
  Keep keep() const { return keep_; }
  size_t Bytes() const;

 private:
  // Triangles first.. of the batch, at most kCoverageBlock.
  void DrawBlock(const StreamBatch& batch, size_t first, size_t count);
  // Of a block, from coverage_: the depths alone, or also who won.
  void KeepDepths();
  void KeepWinners(const StreamBatch& batch, std::span<const Triangle> triangles);
  // Records of the block's winners.
  void AddWinners(const StreamBatch& batch);
  void DrawWhole(const StreamBatch& batch, const Triangle& triangle);
  void DrawClipped(const StreamBatch& batch, const Triangle& triangle);
  void DrawStroke(const StreamBatch& batch, const std::array<uint32_t, 2>& segment);
  // Scan conversion; a, b, c need not lead.
  void Fill(const Corner& a, const Corner& b, const Corner& c, uint32_t element,
            const HitRecord& record);
  HitRecord MakeRecord(const StreamBatch& batch, uint32_t a, uint32_t b, uint32_t c) const;
  Corner MakeCorner(const StreamBatch& batch, uint32_t vertex) const;

  TileBuffer* tile_;
  uint32_t object_ = 0;
  Projection to_;
  Keep keep_ = Keep::kRecords;
  double line_width_ = 1;
  ProjectedBatch projected_;
  CoverageList coverage_;
  std::array<uint32_t, kCoverageBlock> hit_of_{};  // of the block's triangles
  MicroWinners winners_;
};

}  // namespace fjord
