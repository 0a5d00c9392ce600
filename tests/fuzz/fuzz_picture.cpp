// A picture that decodes is whole, and encodes and decodes again to the same samples.
#include "engine/image/codec.h"
#include "tests/fuzz/harness.h"

namespace fjord::fuzz {

void RunPicture(std::string_view bytes) {
  // A few bytes may honestly stand for a picture of a gigabyte; not here.
  constexpr size_t kMostInput = 64 << 10;
  if (bytes.size() > kMostInput) return;
  PictureInfo info;
  const Result<Picture> picture = DecodePicture(bytes, "fuzz", &info);
  if (!picture) {
    FJORD_CHECK(!picture.error().message.empty());
    return;
  }
  const size_t samples = size_t{picture->width} * picture->height * 3;
  FJORD_CHECK(samples > 0);
  FJORD_CHECK(picture->bytes.size() == samples * BytesPerSample(picture->format));
  if (samples > 1'000'000) return;
  const Result<std::string> encoded = EncodePicture(*picture, {});
  FJORD_CHECK(encoded.ok(), encoded.ok() ? "" : encoded.error().message);
  const Result<Picture> again = DecodePicture(*encoded, "again");
  FJORD_CHECK(again.ok(), again.ok() ? "" : again.error().message);
  FJORD_CHECK(again->bytes == picture->bytes);
}

}  // namespace fjord::fuzz
