#include "client/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "client/pixels.h"

namespace fjord {
namespace {

constexpr float kGapColor = .012f;  // linear light: a dark table
constexpr size_t kMostFrames = 400;

// Weights with which the samples of one axis go into one output sample.
struct Span {
  uint32_t first = 0;
  std::vector<float> weight;
};

std::vector<Span> Spans(uint32_t from, uint32_t to) {
  std::vector<Span> spans(to);
  const double step = static_cast<double>(from) / to;
  for (uint32_t i = 0; i < to; ++i) {
    const double begin = i * step;
    const double end = std::min<double>(from, (i + 1) * step);
    spans[i].first = std::min(static_cast<uint32_t>(begin), from - 1);
    for (uint32_t x = spans[i].first; x < from && x < end; ++x) {
      const double covered = std::min<double>(end, x + 1) - std::max<double>(begin, x);
      if (covered > 0) spans[i].weight.push_back(static_cast<float>(covered / (end - begin)));
    }
  }
  return spans;
}

uint32_t ChooseColumns(size_t frames, double aspect) {
  // A sheet about as wide as 16:10.
  const double columns = std::sqrt(static_cast<double>(frames) * 1.6 / aspect);
  return static_cast<uint32_t>(
      std::clamp<double>(std::ceil(columns), 1, static_cast<double>(frames)));
}

}  // namespace

std::vector<float> BoxFilter(const std::vector<float>& linear, uint32_t width, uint32_t height,
                             uint32_t out_width, uint32_t out_height) {
  const std::vector<Span> across = Spans(width, out_width);
  const std::vector<Span> down = Spans(height, out_height);
  std::vector<float> rows(size_t{out_width} * height * 3, 0);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < out_width; ++x) {
      float* out = &rows[(size_t{y} * out_width + x) * 3];
      for (size_t k = 0; k < across[x].weight.size(); ++k) {
        const float* in = &linear[(size_t{y} * width + across[x].first + k) * 3];
        for (int c = 0; c < 3; ++c) out[c] += in[c] * across[x].weight[k];
      }
    }
  }
  std::vector<float> small(size_t{out_width} * out_height * 3, 0);
  for (uint32_t y = 0; y < out_height; ++y) {
    for (size_t k = 0; k < down[y].weight.size(); ++k) {
      const float* in = &rows[(size_t{down[y].first} + k) * out_width * 3];
      float* out = &small[size_t{y} * out_width * 3];
      for (size_t i = 0; i < size_t{out_width} * 3; ++i) out[i] += in[i] * down[y].weight[k];
    }
  }
  return small;
}

Result<Picture> MakeContactSheet(const std::vector<ListedFrame>& frames,
                                 const SheetLayout& layout) {
  if (frames.empty()) return Invalid("there are no pictures for a contact sheet");
  std::vector<ListedFrame> chosen = frames;
  if (frames.size() > kMostFrames) {
    chosen.clear();
    for (size_t i = 0; i < kMostFrames; ++i)
      chosen.push_back(frames[i * (frames.size() - 1) / (kMostFrames - 1)]);
  }
  uint32_t columns = 0, rows = 0, width = 0, height = 0, sheet_width = 0, sheet_height = 0;
  uint32_t full_width = 0, full_height = 0;  // of the first picture
  std::vector<float> sheet;
  for (size_t i = 0; i < chosen.size(); ++i) {
    const Result<Picture> picture = ReadFrame(chosen[i]);
    if (!picture.ok()) return picture.error();
    if (i == 0) {
      full_width = picture->width;
      full_height = picture->height;
      const double aspect = static_cast<double>(picture->width) / picture->height;
      columns = layout.columns > 0 ? layout.columns : ChooseColumns(chosen.size(), aspect);
      columns = std::min<uint32_t>(columns, static_cast<uint32_t>(chosen.size()));
      rows = (static_cast<uint32_t>(chosen.size()) + columns - 1) / columns;
      const uint32_t gaps = (columns + 1) * layout.gap;
      width = std::max(8u, (std::max(layout.width, gaps) - gaps) / columns);
      width = std::min(width, picture->width);
      height = std::max(1u, static_cast<uint32_t>(width / aspect + .5));
      sheet_width = columns * width + gaps;
      sheet_height = rows * height + (rows + 1) * layout.gap;
      if (sheet_width > 16384 || sheet_height > 16384)
        return MakeError(ErrorCode::kLimit,
                         "the sheet would be larger than 16384 pixels; change --columns");
      sheet.assign(size_t{sheet_width} * sheet_height * 3, kGapColor);
    }
    if (!layout.any_size && (picture->width != full_width || picture->height != full_height)) {
      return Invalid("the picture is " + std::to_string(picture->width) + "x" +
                         std::to_string(picture->height) + ", the first one " +
                         std::to_string(full_width) + "x" + std::to_string(full_height) +
                         "; --allow-mixed takes both",
                     {chosen[i].file, 0, 0});
    }
    const std::vector<float> thumbnail = BoxFilter(LinearSamples(*picture, Behind::kChecker),
                                                   picture->width, picture->height, width, height);
    const size_t left = layout.gap + (i % columns) * (width + layout.gap);
    const size_t top = layout.gap + (i / columns) * (height + layout.gap);
    for (size_t y = 0; y < height; ++y) {
      std::copy_n(&thumbnail[y * width * 3], size_t{width} * 3,
                  &sheet[((top + y) * sheet_width + left) * 3]);
    }
  }
  return Quantise(sheet_width, sheet_height, PixelFormat::kPng8, sheet);
}

}  // namespace fjord
