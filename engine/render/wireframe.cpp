#include "engine/render/wireframe.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "engine/base/clamp.h"
#include "engine/render/wireframe_edges.h"

namespace fjord {
namespace {

// One-pixel lines with two pixels of coverage a step; a pixel keeps the most it got.
class Plotter {
 public:
  Plotter(uint32_t width, uint32_t height)
      : width_(width), height_(height), ink_(size_t{width} * height, 0) {}

  void Line(const ScreenEdge& s) {
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

WireframeStats StatsOf(const FrameEdges& edges) {
  return {edges.edges.size(), edges.coarser, edges.longest_only, edges.made};
}

}  // namespace

Result<WireframePicture> RenderWireframe(const BuiltFrame& frame, size_t cap) {
  const Result<FrameEdges> edges = EdgesInView(frame, std::max<size_t>(cap, 1));
  if (!edges) return edges.error();
  Plotter plotter(frame.width, frame.height);
  for (const ScreenEdge& edge : edges->edges) plotter.Line(edge);
  return WireframePicture{plotter.Finish(), StatsOf(*edges)};
}

Result<WireframeDrawing> WireframeSvg(const BuiltFrame& frame, size_t cap) {
  const Result<FrameEdges> edges = EdgesInView(frame, std::max<size_t>(cap, 1));
  if (!edges) return edges.error();
  const std::string size = std::to_string(frame.width) + ' ' + std::to_string(frame.height);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
                    "\" width=\"" + std::to_string(frame.width) + "\" height=\"" +
                    std::to_string(frame.height) +
                    "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#0d121b\"/>\n"
                    "<path fill=\"none\" stroke=\"#c4deff\" stroke-width=\".7\" d=\"";
  for (const ScreenEdge& s : edges->edges) {
    svg += 'M' + Hundredths(s.x0) + ' ' + Hundredths(s.y0) + 'L' + Hundredths(s.x1) + ' ' +
           Hundredths(s.y1) + '\n';
  }
  svg += "\"/>\n</svg>\n";
  return WireframeDrawing{std::move(svg), StatsOf(*edges)};
}

}  // namespace fjord
