#include "engine/image/codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstring>
#include <memory>

#include "engine/image/exr_header.h"
#include "engine/image/png_chunks.h"

namespace fjord {
namespace {

constexpr int kLargestSide = 16384;

// Every attribute of ours carries this, so that none is taken for something the file format knows.
constexpr std::string_view kPrefix = "fjord:";

OIIO::TypeDesc SampleType(PixelFormat format) {
  switch (format) {
    case PixelFormat::kPng8:
      return OIIO::TypeDesc::UINT8;
    case PixelFormat::kPng16:
      return OIIO::TypeDesc::UINT16;
    case PixelFormat::kExrHalf:
      return OIIO::TypeDesc::HALF;
    case PixelFormat::kExrFloat:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

// Whether the first bytes are those of a PNG or an EXR: OpenImageIO is never asked to guess.
std::string FormatOf(std::string_view bytes) {
  if (bytes.substr(0, 8) == std::string_view("\x89PNG\r\n\x1a\n", 8)) return "png";
  if (bytes.substr(0, 4) == std::string_view("\x76\x2f\x31\x01", 4)) return "exr";
  return "";
}

Error Broken(const std::string& name, const std::string& why) {
  return Invalid("the picture cannot be read (" + why + "); make it again", Place{name});
}

// One thread: the caller decides how many cores a frame may use.
void SetUpOnce() {
  static const bool kDone = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return true;
  }();
  (void)kDone;
}

}  // namespace

Result<std::string> EncodePicture(const Picture& picture, const PictureInfo& info) {
  SetUpOnce();
  const std::string ending = FileEnding(picture.format);
  std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(ending);
  if (!out) {
    return MakeError(ErrorCode::kInternal,
                     "this OpenImageIO cannot write ." + ending + " (" + OIIO::geterror() + ")");
  }
  OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height), 3,
                       SampleType(picture.format));
  if (ending == "png") {
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("compression", "zip:1");
    spec.attribute("png:filter", 0x10);  // Sub: cheap, and it suits noisy terrain
    spec.attribute("oiio:ColorSpace", "sRGB");
  } else {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the writer puts today's in
    spec.attribute("oiio:ColorSpace", "linear");
  }
  for (const auto& [key, value] : info) spec.attribute(std::string(kPrefix) + key, value);
  OIIO::Filesystem::IOVecOutput buffer;
  OIIO::Filesystem::IOProxy* proxy = &buffer;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::string name = "frame." + ending;
  if (!out->open(name, spec) ||
      !out->write_image(SampleType(picture.format), picture.bytes.data()) || !out->close()) {
    return MakeError(ErrorCode::kInternal, "the picture cannot be encoded: " + out->geterror());
  }
  const std::vector<unsigned char>& bytes = buffer.buffer();
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<Picture> DecodePicture(std::string_view bytes, const std::string& name, PictureInfo* info) {
  SetUpOnce();
  const std::string ending = FormatOf(bytes);
  if (ending.empty()) return Broken(name, "neither PNG nor OpenEXR");
  const Result<> sound =
      ending == "exr" ? CheckExrHeader(bytes, kLargestSide) : CheckPngChunks(bytes, kLargestSide);
  if (!sound.ok()) {
    if (sound.error().code != ErrorCode::kLimit) return Broken(name, sound.error().message);
    return MakeError(ErrorCode::kLimit, sound.error().message, Place{name});
  }
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  std::unique_ptr<OIIO::ImageInput> in =
      OIIO::ImageInput::create("frame." + ending, false, nullptr, &reader);
  if (!in) return Broken(name, OIIO::geterror());
  OIIO::ImageSpec config;
  OIIO::Filesystem::IOProxy* proxy = &reader;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  OIIO::ImageSpec spec;
  if (!in->open("frame." + ending, spec, config)) return Broken(name, in->geterror());
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1) return Broken(name, "no flat picture");
  if (spec.width > kLargestSide || spec.height > kLargestSide) {
    return MakeError(ErrorCode::kLimit,
                     "the picture is " + std::to_string(spec.width) + "x" +
                         std::to_string(spec.height) + "; at most 16384x16384 are read",
                     Place{name});
  }
  if (spec.nchannels < 3) return Broken(name, "fewer than three channels");
  Picture picture;
  picture.width = static_cast<uint32_t>(spec.width);
  picture.height = static_cast<uint32_t>(spec.height);
  if (ending == "png") {
    picture.format =
        spec.format == OIIO::TypeDesc::UINT16 ? PixelFormat::kPng16 : PixelFormat::kPng8;
  } else {
    picture.format =
        spec.format == OIIO::TypeDesc::HALF ? PixelFormat::kExrHalf : PixelFormat::kExrFloat;
  }
  // A header can claim any size; deflate packs at most about 1030 to 1.
  const size_t claimed =
      size_t{picture.width} * picture.height * 3 * BytesPerSample(picture.format);
  if (claimed / 1100 > bytes.size()) return Broken(name, "shorter than its header says");
  picture.bytes.resize(claimed);
  if (!in->read_image(0, 0, 0, 3, SampleType(picture.format), picture.bytes.data())) {
    return Broken(name, in->geterror());
  }
  if (info) {
    info->clear();
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
      const std::string key = value.name().string();
      if (key.compare(0, kPrefix.size(), kPrefix) != 0) continue;
      if (value.type() != OIIO::TypeDesc::STRING) continue;
      info->emplace_back(key.substr(kPrefix.size()), value.get_string());
    }
  }
  in->close();
  return picture;
}

}  // namespace fjord
