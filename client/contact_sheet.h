// A contact sheet: many frames as thumbnails on one picture, box-filtered in linear light;
// transparent ones over grey squares.
#pragma once

#include <string>
#include <vector>

#include "client/frame_list.h"
#include "engine/base/result.h"
#include "engine/image/picture.h"

namespace fjord {

struct SheetLayout {
  uint32_t columns = 0;   // 0: chosen
  uint32_t width = 1920;  // of the whole sheet, about
  uint32_t gap = 4;       // pixels between thumbnails and around them
  bool any_size = false;  // pictures of another size than the first are scaled to its shape
};

// Frames are files of one size, in order.
Result<Picture> MakeContactSheet(const std::vector<ListedFrame>& frames, const SheetLayout& layout);

// `linear` (width x height) scaled down to out_width x out_height: each pixel the mean of what it
// covers.
std::vector<float> BoxFilter(const std::vector<float>& linear, uint32_t width, uint32_t height,
                             uint32_t out_width, uint32_t out_height);

}  // namespace fjord
