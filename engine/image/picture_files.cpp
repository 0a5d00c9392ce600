// The module fjord_picture_files: the only file that names OpenImageIO.
#include "engine/image/picture_files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace fjord {
namespace {

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

// One thread: the caller decides how many cores a frame may use.
void SetUpOnce() {
  static const bool kDone = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return true;
  }();
  (void)kDone;
}

// Layers that are read and written, and the channels that hold them.
struct LayerChannel {
  const char* layer;
  const char* channel;
};
constexpr LayerChannel kLayerChannels[] = {{"depth", "Z"}};

const char* ChannelOf(const std::string& layer) {
  for (const LayerChannel& known : kLayerChannels) {
    if (layer == known.layer) return known.channel;
  }
  return nullptr;
}

// Colours and layers pixel by pixel, each channel in its own type, as OpenImageIO takes them. False
// where a layer has no channel.
bool Interleave(const Picture& picture, OIIO::ImageSpec* spec, std::vector<uint8_t>* pixels) {
  spec->channelformats.assign(picture.channels(), SampleType(picture.format));
  for (const PictureLayer& layer : picture.layers) {
    const char* channel = ChannelOf(layer.name);
    if (channel == nullptr) return false;
    spec->channelformats.push_back(OIIO::TypeDesc::FLOAT);
    spec->channelnames.emplace_back(channel);
    if (std::string_view(channel) == "Z") spec->z_channel = static_cast<int>(spec->nchannels);
    ++spec->nchannels;
  }
  const size_t color = picture.channels() * SampleType(picture.format).size();
  const size_t stride = color + picture.layers.size() * sizeof(float);
  const size_t count = size_t{picture.width} * picture.height;
  pixels->resize(count * stride);
  for (size_t i = 0; i < count; ++i) {
    uint8_t* to = pixels->data() + i * stride;
    std::memcpy(to, &picture.bytes[i * color], color);
    to += color;
    for (const PictureLayer& layer : picture.layers) {
      std::memcpy(to, &layer.samples[i], sizeof(float));
      to += sizeof(float);
    }
  }
  return true;
}

bool Encode(const Picture& picture, const std::string& ending, const PictureInfo& info,
            std::string* bytes_or_why) {
  SetUpOnce();
  std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(ending);
  if (!out) {
    *bytes_or_why = "this OpenImageIO cannot write ." + ending + " (" + OIIO::geterror() + ")";
    return false;
  }
  OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height),
                       static_cast<int>(picture.channels()), SampleType(picture.format));
  if (ending == "png") {
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("compression", "rle");  // a quarter faster than matching, 4 % larger
    spec.attribute("png:filter", 0x10);    // Sub: cheap, and it suits noisy terrain
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (picture.alpha) spec.attribute("oiio:UnassociatedAlpha", 1);  // as PNG has it
  } else {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the writer puts today's in
    spec.attribute("oiio:ColorSpace", "linear");
  }
  for (const auto& [key, value] : info) spec.attribute(std::string(kPrefix) + key, value);
  std::vector<uint8_t> interleaved;
  if (!picture.layers.empty() && (ending == "png" || !Interleave(picture, &spec, &interleaved))) {
    *bytes_or_why = "layers go into .exr files only, and only those that are known";
    return false;
  }
  const void* pixels = interleaved.empty() ? picture.bytes.data() : interleaved.data();
  const OIIO::TypeDesc type =
      interleaved.empty() ? SampleType(picture.format) : OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN);
  OIIO::Filesystem::IOVecOutput buffer;
  OIIO::Filesystem::IOProxy* proxy = &buffer;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::string name = "frame." + ending;
  if (!out->open(name, spec) || !out->write_image(type, pixels) || !out->close()) {
    *bytes_or_why = "the picture cannot be encoded: " + out->geterror();
    return false;
  }
  const std::vector<unsigned char>& bytes = buffer.buffer();
  bytes_or_why->assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return true;
}

PixelFormat FormatOf(const std::string& ending, const OIIO::ImageSpec& spec) {
  if (ending == "png")
    return spec.format == OIIO::TypeDesc::UINT16 ? PixelFormat::kPng16 : PixelFormat::kPng8;
  return spec.channelformat(0) == OIIO::TypeDesc::HALF ? PixelFormat::kExrHalf
                                                       : PixelFormat::kExrFloat;
}

bool Decode(std::string_view bytes, const std::string& ending, Picture* picture, PictureInfo* info,
            std::string* why) {
  SetUpOnce();
  const auto fail = [&](const std::string& message) {
    *why = message;
    return false;
  };
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  std::unique_ptr<OIIO::ImageInput> in =
      OIIO::ImageInput::create("frame." + ending, false, nullptr, &reader);
  if (!in) return fail(OIIO::geterror());
  OIIO::ImageSpec config;
  OIIO::Filesystem::IOProxy* proxy = &reader;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  config.attribute("oiio:UnassociatedAlpha", 1);  // a PNG's samples as they are
  OIIO::ImageSpec spec;
  if (!in->open("frame." + ending, spec, config)) return fail(in->geterror());
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1) return fail("no flat picture");
  picture->width = static_cast<uint32_t>(spec.width);
  picture->height = static_cast<uint32_t>(spec.height);
  picture->format = FormatOf(ending, spec);
  picture->alpha = spec.nchannels >= 4 && spec.alpha_channel == 3;
  // A header can claim any size; deflate packs at most about 1030 to 1.
  const size_t claimed = size_t{picture->width} * picture->height * picture->channels() *
                         SampleType(picture->format).size();
  if (claimed / 1100 > bytes.size()) return fail("shorter than its header says");
  picture->bytes.resize(claimed);
  // Grey, with or without alpha: the one channel three times.
  const int channels = spec.nchannels < 3 ? 1 : static_cast<int>(picture->channels());
  const size_t sample = SampleType(picture->format).size();
  if (!in->read_image(0, 0, 0, channels, SampleType(picture->format), picture->bytes.data(),
                      static_cast<OIIO::stride_t>(picture->channels() * sample))) {
    return fail(in->geterror());
  }
  for (size_t at = 0; channels == 1 && at < claimed; at += 3 * sample) {
    for (size_t k = 1; k < 3; ++k) {
      std::memcpy(&picture->bytes[at + k * sample], &picture->bytes[at], sample);
    }
  }
  picture->layers.clear();
  for (const LayerChannel& known : kLayerChannels) {
    const int channel = spec.channelindex(known.channel);
    if (ending != "exr" || channel < static_cast<int>(picture->channels())) continue;
    PictureLayer layer{known.layer, {}};
    layer.samples.resize(size_t{picture->width} * picture->height);
    if (!in->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, layer.samples.data()))
      return fail(in->geterror());
    picture->layers.push_back(std::move(layer));
  }
  if (info != nullptr) {
    info->clear();
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
      const std::string key = value.name().string();
      if (key.compare(0, kPrefix.size(), kPrefix) != 0) continue;
      if (value.type() != OIIO::TypeDesc::STRING) continue;
      info->emplace_back(key.substr(kPrefix.size()), value.get_string());
    }
  }
  in->close();
  return true;
}

}  // namespace

extern "C" const PictureFiles* FjordPictureFiles3() {
  static constexpr PictureFiles kFiles{Encode, Decode};
  return &kFiles;
}

}  // namespace fjord
