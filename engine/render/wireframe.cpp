#include "engine/render/wireframe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/base/clamp.h"
#include "engine/render/build.h"
#include "engine/render/clip.h"
#include "engine/render/places.h"
#include "engine/render/view.h"

namespace fjord {
namespace {

constexpr double kCoarsest = 1e12;

using Edge = std::array<uint32_t, 2>;

std::vector<Edge> EdgesOf(const WeldedShape& shape) {
  std::vector<Edge> edges;
  const auto add = [&](uint32_t a, uint32_t b) {
    edges.push_back(a < b ? Edge{a, b} : Edge{b, a});
  };
  if (shape.curve) {
    const auto count = static_cast<uint32_t>(shape.mesh.points.size());
    for (uint32_t i = 1; i < count; ++i) add(i - 1, i);
    if (shape.closed && count > 2) add(count - 1, 0);
    return edges;
  }
  size_t at = 0;
  for (const uint32_t size : shape.mesh.face_size) {
    for (uint32_t i = 0; i < size; ++i) {
      add(shape.mesh.face_vertex[at + i], shape.mesh.face_vertex[at + (i + 1) % size]);
    }
    at += size;
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

struct ObjectEdges {
  WeldedShape shape;
  std::vector<Edge> edges;
};

struct FrameEdges {
  std::vector<ObjectEdges> objects;
  uint64_t count = 0;
  bool fits = true;
};

uint64_t TimesDrawn(const BuiltObject& object) {
  return std::max<uint64_t>(1, object.placements.size());
}

Result<FrameEdges> WeldFrame(const BuiltFrame& frame, double coarser, size_t cap) {
  FrameEdges all;
  for (const BuiltObject& object : frame.objects) {
    Result<std::shared_ptr<const PreparedFractal>> prepared = object.prepared;
    if (coarser != 1) prepared = PrepareObject(object, coarser);
    if (!prepared) return prepared.error();
    WeldLimits limits;
    limits.max_points = std::max<uint64_t>(cap, object.shape->now.size());
    Result<WeldedShape> shape = (*prepared)->Weld(limits);
    if (!shape && shape.error().code != ErrorCode::kLimit) return shape.error();
    if (!shape) {
      all.fits = false;
      return all;
    }
    ObjectEdges edges{std::move(*shape), {}};
    edges.edges = EdgesOf(edges.shape);
    all.count += edges.edges.size() * TimesDrawn(object);
    all.objects.push_back(std::move(edges));
    if (all.count > cap) all.fits = false;
  }
  return all;
}

// The finest that fits. Where coarse shapes alone are too many, every so-many-th edge is left.
Result<FrameEdges> EdgesUnder(const BuiltFrame& frame, size_t cap, double* coarser) {
  uint64_t last = 0;
  for (*coarser = 1;; *coarser *= 2) {
    Result<FrameEdges> all = WeldFrame(frame, *coarser, cap);
    if (!all || all->fits) return all;
    const bool complete = all->objects.size() == frame.objects.size();
    if (complete && (all->count == last || *coarser > kCoarsest)) {
      const uint64_t stride = (all->count + cap - 1) / cap;
      all->count = 0;
      for (size_t o = 0; o < all->objects.size(); ++o) {
        ObjectEdges& object = all->objects[o];
        size_t kept = 0;
        for (size_t i = 0; i < object.edges.size(); i += stride) {
          object.edges[kept++] = object.edges[i];
        }
        object.edges.resize(kept);
        all->count += kept * TimesDrawn(frame.objects[o]);
      }
      return all;
    }
    if (*coarser > 4 * kCoarsest) {
      return MakeError(ErrorCode::kLimit,
                       "the coarse shapes alone have too many points to preview");
    }
    last = complete ? all->count : 0;
  }
}

struct Segment {
  double x0, y0, x1, y1;  // pixels, cut to the picture and a little more
};

// Liang-Barsky against -1 .. size + 1.
bool CutToPicture(const BuiltFrame& frame, Segment* s) {
  const double dx = s->x1 - s->x0, dy = s->y1 - s->y0;
  double from = 0, to = 1;
  const auto side = [&](double p, double q) {  // p t <= q
    if (p == 0) return q >= 0;
    const double t = q / p;
    if (p < 0) {
      from = std::max(from, t);
    } else {
      to = std::min(to, t);
    }
    return from <= to;
  };
  if (!side(-dx, s->x0 + 1) || !side(dx, frame.width + 1 - s->x0) || !side(-dy, s->y0 + 1) ||
      !side(dy, frame.height + 1 - s->y0)) {
    return false;
  }
  *s = {s->x0 + dx * from, s->y0 + dy * from, s->x0 + dx * to, s->y0 + dy * to};
  return true;
}

// Of each object, at each of its places.
std::vector<std::pair<size_t, Projection>> ProjectionsOf(const BuiltFrame& frame,
                                                         const View& view) {
  std::vector<std::pair<size_t, Projection>> projections;
  for (const ObjectPlace& place : PlacesSeen(frame, view)) {
    projections.emplace_back(place.object, MakeProjection(view, place.transform));
  }
  return projections;
}

// All edges on the picture, in order. `draw(segment)`.
template <typename Draw>
void ProjectEdges(const BuiltFrame& frame, const FrameEdges& all, const Draw& draw) {
  const View view = MakeView(frame.camera, frame.width, frame.height);
  for (const auto& [o, to] : ProjectionsOf(frame, view)) {
    for (const Edge& edge : all.objects[o].edges) {
      ClipPolygon line;
      line.size = 2;
      for (int i = 0; i < 2; ++i) {
        line.corner[i].clip = ToClip(to, all.objects[o].shape.mesh.points[edge[i]]);
      }
      ClipToView(to, &line);
      if (line.size != 2) continue;
      double x[2], y[2];
      for (int i = 0; i < 2; ++i) {
        const ClipPoint& p = line.corner[i].clip;
        const double scale = (to.orthographic ? 1 : 1 / p.z) / kFixedOne;
        x[i] = p.x * scale;
        y[i] = p.y * scale;
      }
      Segment segment{x[0], y[0], x[1], y[1]};
      if (CutToPicture(frame, &segment)) draw(segment);
    }
  }
}

// One-pixel lines with two pixels of coverage a step; a pixel keeps the most it got.
class Plotter {
 public:
  Plotter(uint32_t width, uint32_t height)
      : width_(width), height_(height), ink_(size_t{width} * height, 0) {}

  void Line(const Segment& s) {
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0;
    const bool steep = (dx < 0 ? -dx : dx) < (dy < 0 ? -dy : dy);
    // along the longer axis u, from pixel centre to pixel centre; v in 1/65536 pixel
    double u0 = steep ? s.y0 : s.x0, v0 = steep ? s.x0 : s.y0;
    double u1 = steep ? s.y1 : s.x1, v1 = steep ? s.x1 : s.y1;
    if (u0 > u1) {
      std::swap(u0, u1);
      std::swap(v0, v1);
    }
    const int32_t first = FloorToInt32(u0), last = FloorToInt32(u1);
    const double slope = u1 > u0 ? (v1 - v0) / (u1 - u0) : 0;
    for (int32_t u = first; u <= last; ++u) {
      const double at = std::min(std::max(u + .5, u0), u1);
      const int32_t v = FloorToInt32((v0 + (at - u0) * slope - .5) * 65536);
      const int32_t whole = v >> 16;
      const int32_t part = (v >> 8) & 255;
      Put(steep, u, whole, 255 - part);
      Put(steep, u, whole + 1, part);
    }
  }

  Picture Finish() const {
    constexpr std::array<int32_t, 3> kPaper = {13, 18, 27}, kInk = {196, 222, 255};
    Picture picture{width_, height_, PixelFormat::kPng8, {}};
    picture.bytes.resize(ink_.size() * 3);
    for (size_t i = 0; i < ink_.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        picture.bytes[3 * i + k] =
            static_cast<uint8_t>(kPaper[k] + (kInk[k] - kPaper[k]) * ink_[i] / 255);
      }
    }
    return picture;
  }

 private:
  void Put(bool steep, int32_t u, int32_t v, int32_t ink) {
    const int32_t x = steep ? v : u, y = steep ? u : v;
    if (x < 0 || y < 0 || x >= static_cast<int32_t>(width_) || y >= static_cast<int32_t>(height_)) {
      return;
    }
    uint8_t& there = ink_[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)];
    there = std::max(there, static_cast<uint8_t>(ink));
  }

  uint32_t width_, height_;
  std::vector<uint8_t> ink_;
};

// Hundredths of a pixel.
std::string Hundredths(double v) {
  const int32_t whole = RoundToInt32(v * 100);
  const int32_t size = whole < 0 ? -whole : whole;
  std::string text;
  if (whole < 0) text += '-';
  text += std::to_string(size / 100);
  if (size % 100 != 0) {
    text += '.';
    text += static_cast<char>('0' + size % 100 / 10);
    if (size % 10 != 0) text += static_cast<char>('0' + size % 10);
  }
  return text;
}

}  // namespace

Result<WireframePicture> RenderWireframe(const BuiltFrame& frame, size_t cap) {
  WireframeStats stats;
  const Result<FrameEdges> all = EdgesUnder(frame, std::max<size_t>(cap, 1), &stats.coarser);
  if (!all) return all.error();
  stats.edges = all->count;
  Plotter plotter(frame.width, frame.height);
  ProjectEdges(frame, *all, [&](const Segment& s) { plotter.Line(s); });
  return WireframePicture{plotter.Finish(), stats};
}

Result<WireframeDrawing> WireframeSvg(const BuiltFrame& frame, size_t cap) {
  WireframeStats stats;
  const Result<FrameEdges> all = EdgesUnder(frame, std::max<size_t>(cap, 1), &stats.coarser);
  if (!all) return all.error();
  stats.edges = all->count;
  const std::string size = std::to_string(frame.width) + ' ' + std::to_string(frame.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                    "\" width=\"" + std::to_string(frame.width) + "\" height=\"" +
                    std::to_string(frame.height) +
                    "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#0d121b\"/>\n"
                    "<path fill=\"none\" stroke=\"#c4deff\" stroke-width=\".7\" d=\"";
  ProjectEdges(frame, *all, [&](const Segment& s) {
    svg += 'M' + Hundredths(s.x0) + ' ' + Hundredths(s.y0) + 'L' + Hundredths(s.x1) + ' ' +
           Hundredths(s.y1) + '\n';
  });
  svg += "\"/>\n</svg>\n";
  return WireframeDrawing{std::move(svg), stats};
}

}  // namespace fjord
