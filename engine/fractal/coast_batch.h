// Gathers the leaf triangles of a coast and gives them to a sink a batch at a time. Not for sharing
// between threads; Flush before it goes.
#pragma once

#include <vector>

#include "engine/fractal/coast_pieces.h"

namespace fjord {

class TriangleBatch {
 public:
  TriangleBatch(StreamSink& sink, size_t size, size_t element)
      : sink_(sink),
        size_(size < 16 ? 16 : size),
        element_(static_cast<uint32_t>(element)),
        places_read_(sink.ReadsPlaces()) {}

  void Add(const CoastVertex& a, const CoastVertex& b, const CoastVertex& c);
  void Flush();

 private:
  uint32_t Index(const CoastVertex& v);

  StreamSink& sink_;
  const size_t size_;
  const uint32_t element_;
  const bool places_read_;
  std::vector<StreamVertex> vertices_;
  std::vector<Identity> ids_;
  std::vector<Triangle> triangles_;
  std::vector<Weights> places_;
};

}  // namespace fjord
