#include "engine/fractal/coast_batch.h"

namespace fjord {

void TriangleBatch::Add(const CoastVertex& a, const CoastVertex& b, const CoastVertex& c) {
  const Triangle triangle = {Index(a), Index(b), Index(c)};
  triangles_.push_back(triangle);
  if (triangles_.size() >= size_) {
    Flush();
  }
}

void TriangleBatch::Flush() {
  if (!triangles_.empty()) {
    sink_.Take({vertices_, triangles_, {}, places_, element_});
  }
  vertices_.clear();
  ids_.clear();
  triangles_.clear();
  places_.clear();
}

// Among the last few, where neighbours are; else a new one.
uint32_t TriangleBatch::Index(const CoastVertex& v) {
  const size_t count = ids_.size();
  for (size_t i = count; i > 0 && i + 8 > count; --i) {
    if (ids_[i - 1] == v.line.id) {
      return static_cast<uint32_t>(i - 1);
    }
  }
  StreamVertex out = ToStream(v.line);
  out.direction = v.normal;
  vertices_.push_back(out);
  ids_.push_back(v.line.id);
  if (places_read_) {
    places_.push_back(v.line.place);
  }
  return static_cast<uint32_t>(count);
}

}  // namespace fjord
