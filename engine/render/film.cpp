#include "engine/render/film.h"

#include <algorithm>
#include <limits>

namespace fjord {
namespace {

// Are these sixteen, which is a whole number of pixels, all without a hit? It has all bits set.
bool NoneHit(const uint32_t* hit) {
  uint32_t all = kNoHit;
  for (int i = 0; i < 16; ++i) all &= hit[i];
  return all == kNoHit;
}

}  // namespace

void Film::Start(const FrameSetup& setup, const TileRect& tile) {
  setup_ = &setup;
  tile_ = tile;
  places_ = SamplePlaces(setup.frame.samples);
  const size_t count = static_cast<size_t>(tile.width) * places_.size();
  constexpr size_t kPadding = 64;  // SIMD lanes may read past the end
  owner_.resize(count + kPadding);
  for (auto& channel : row_) channel.resize(count + kPadding);
  is_present_.assign(setup.owners.size(), 0);
  fragments_.clear();
}

void Film::AddFragments(uint32_t owner, const TileBuffer& drawn) {
  const size_t row = static_cast<size_t>(tile_.width) * places_.size();
  for (int32_t y = drawn.rect().y; y < drawn.rect().bottom(); ++y) {
    const uint32_t* hit = drawn.hit() + drawn.Index(tile_.x, y, 0);
    hits_.Resize(row - static_cast<size_t>(std::count(hit, hit + row, kNoHit)));
    if (hits_.size == 0) continue;
    hits_.size = 0;
    for (size_t at = 0; at < row; ++at) {
      if (hit[at] != kNoHit) AddSample(drawn, y, at);
    }
    passes_.Run({*setup_, setup_->exposure, &drawn, owner, y}, &hits_);
    const size_t first = static_cast<size_t>(y - tile_.y) * row;
    for (size_t i = 0; i < hits_.size; ++i) {
      fragments_.push_back({static_cast<uint32_t>(first + hits_.place[i]), owner, hits_.depth[i],
                            Rgb(hits_.color[0][i], hits_.color[1][i], hits_.color[2][i]),
                            setup_->owners[owner].opacity});
    }
  }
}

// The plane's depth at a sample of pixel x of the tile.
double Film::SeaDepth(int32_t x, int32_t y, const SamplePlace& place) const {
  return setup_->sea->At(static_cast<double>((tile_.x + x) * kFixedOne + place.x),
                         static_cast<double>(y * kFixedOne + place.y));
}

// Whom the samples of a row belong to where nothing was drawn; none: to the sea or the sky. Rounded
// sums and products are monotone, so the corners of the row's box speak for all that lies between.
std::optional<uint32_t> Film::BehindRow(int32_t y) const {
  if (!setup_->sea) return setup_->sky_owner;
  const ViewPlane& sea = *setup_->sea;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const int32_t x : {tile_.x, tile_.right()}) {
    for (const int32_t down : {0, 1}) {
      const double at =
          sea.At(static_cast<double>(x * kFixedOne), static_cast<double>((y + down) * kFixedOne));
      least = std::min(least, at);
      most = std::max(most, at);
    }
  }
  if (sea.Seen(least) && sea.Seen(most)) return setup_->sea_owner;
  if (most <= sea.least || least > sea.most) return setup_->sky_owner;
  return std::nullopt;
}

Film::Span Film::DrawnPixels(const TileBuffer& drawn, int32_t y) const {
  const auto samples = static_cast<int32_t>(places_.size());
  const uint32_t* hit = drawn.hit() + drawn.Index(tile_.x, y, 0);
  int32_t first = 0, end = tile_.width * samples;
  while (end - first >= 16 && NoneHit(hit + first)) first += 16;
  while (end - first >= 16 && NoneHit(hit + end - 16)) end -= 16;
  return {first / samples, (end + samples - 1) / samples};
}

std::span<const Fragment> Film::FragmentsOfRow(int32_t y) const {
  const auto row = static_cast<uint32_t>(tile_.width) * static_cast<uint32_t>(places_.size());
  const uint32_t first = static_cast<uint32_t>(y - tile_.y) * row;
  return FragmentsOf(fragments_, first, first + row);
}

// Pixels whose samples all have the same owner, which is no object.
void Film::FillPlain(int32_t y, Span pixels, uint32_t owner, float* out) {
  const size_t samples = places_.size();
  const bool whole_row = setup_->owners[owner].grain == Grain::kRow;
  hits_.Resize(whole_row ? 1 : static_cast<size_t>(pixels.end - pixels.first));
  hits_.size = 0;
  for (int32_t x = pixels.first; x < (whole_row ? pixels.first + 1 : pixels.end); ++x) {
    AddPixel(x, y, owner, 0);
  }
  passes_.Run({*setup_, setup_->exposure, nullptr, owner, y}, &hits_);
  const float share = 1.f / static_cast<float>(samples);
  const auto average = [&](float color) {
    float sum = color;
    for (size_t s = 1; s < samples; ++s) sum += color;
    return sum * share;
  };
  const auto channels = static_cast<int32_t>(setup_->channels());
  for (int k = 0; k < 3; ++k) {
    const float* color = hits_.color[k].data();
    if (whole_row) {
      const float all = average(color[0]);
      for (int32_t x = pixels.first; x < pixels.end; ++x) out[channels * x + k] = all;
      continue;
    }
    for (int32_t x = pixels.first; x < pixels.end; ++x) {
      out[channels * x + k] = average(color[x - pixels.first]);
    }
  }
  if (channels < 4) return;
  const float alpha = owner == setup_->sky_owner ? 0 : 1;
  for (int32_t x = pixels.first; x < pixels.end; ++x) out[channels * x + 3] = alpha;
}

// The sea was laid under everything else before it was drawn: where no hit is, it shows.
void Film::FindOwners(int32_t y, Span pixels, const TileBuffer* drawn) {
  const uint32_t* hit = drawn != nullptr ? drawn->hit() + drawn->Index(tile_.x, y, 0) : nullptr;
  const bool one = setup_->objects.size() == 1;
  for (const uint32_t owner : present_) is_present_[owner] = 0;
  present_.clear();
  size_t at = static_cast<size_t>(pixels.first) * places_.size();
  uint32_t last = setup_->sky_owner + 1;  // nobody
  for (int32_t x = pixels.first; x < pixels.end; ++x) {
    for (const SamplePlace& place : places_) {
      uint32_t owner = 0;
      if (hit != nullptr && hit[at] != kNoHit) {
        owner = one ? 0 : drawn->record(hit[at]).object;
      } else {
        const bool sea = setup_->sea && setup_->sea->Seen(SeaDepth(x, y, place));
        owner = sea ? setup_->sea_owner : setup_->sky_owner;
      }
      owner_[at++] = owner;
      if (owner == last) continue;
      last = owner;
      if (is_present_[owner] == 0) present_.push_back(owner);
      is_present_[owner] = 1;
    }
  }
}

// A pixel, or the row that it is the first of, by its middle.
void Film::AddPixel(int32_t x, int32_t y, uint32_t owner, size_t sample) {
  constexpr int32_t kHalf = kFixedOne / 2;
  const size_t i = hits_.size++;
  hits_.place[i] = static_cast<uint32_t>(x);
  hits_.x[i] = static_cast<double>((tile_.x + x) * kFixedOne + kHalf);
  hits_.y[i] = static_cast<double>(y * kFixedOne + kHalf);
  // of the sample, not of the middle, which may lie beyond the horizon
  hits_.depth[i] =
      setup_->owners[owner].kind == OwnerKind::kSea ? SeaDepth(x, y, places_[sample]) : 1;
}

// A sample of a row as it is in the buffer.
inline void Film::AddSample(const TileBuffer& drawn, int32_t y, size_t at) {
  const size_t index = drawn.Index(tile_.x, y, 0) + at;
  const size_t i = hits_.size++;
  hits_.place[i] = static_cast<uint32_t>(at);
  hits_.x[i] = drawn.sample_x()[at];
  hits_.y[i] = static_cast<double>(y * kFixedOne) + drawn.sample_y()[at];
  hits_.depth[i] = drawn.depth()[index];
  hits_.record[i] = drawn.hit()[index];
  __builtin_prefetch(&drawn.record(hits_.record[i]));  // read when the row is complete
}

void Film::CollectSamples(int32_t y, Span pixels, uint32_t owner, const TileBuffer& drawn) {
  const size_t end = static_cast<size_t>(pixels.end) * places_.size();
  hits_.size = 0;
  for (size_t at = static_cast<size_t>(pixels.first) * places_.size(); at < end; ++at) {
    if (owner_[at] == owner) AddSample(drawn, y, at);
  }
}

// The hits of one owner of a row.
void Film::Collect(int32_t y, Span pixels, uint32_t owner, const TileBuffer* drawn) {
  const size_t samples = places_.size();
  const Grain grain = setup_->owners[owner].grain;
  const auto width = static_cast<size_t>(pixels.end - pixels.first);
  hits_.Resize(grain == Grain::kSample ? width * samples : width);
  if (grain == Grain::kSample) {
    CollectSamples(y, pixels, owner, *drawn);
    return;
  }
  hits_.size = 0;
  for (int32_t x = pixels.first; x < pixels.end; ++x) {
    const uint32_t* of_pixel = &owner_[static_cast<size_t>(x) * samples];
    const uint32_t* first = std::find(of_pixel, of_pixel + samples, owner);
    if (first == of_pixel + samples) continue;
    AddPixel(x, y, owner, static_cast<size_t>(first - of_pixel));
    if (grain == Grain::kRow) return;
  }
}

// Colours of hits to the samples that they stand for.
void Film::Scatter(Span pixels, uint32_t owner) {
  const size_t samples = places_.size();
  const Grain grain = setup_->owners[owner].grain;
  for (int k = 0; k < 3; ++k) {
    const float* color = hits_.color[k].data();
    float* row = row_[k].data();
    if (grain == Grain::kSample) {
      for (size_t i = 0; i < hits_.size; ++i) row[hits_.place[i]] = color[i];
      continue;
    }
    for (size_t i = 0; i < hits_.size; ++i) {
      const size_t first = hits_.place[i] * samples;
      const size_t end =
          grain == Grain::kRow ? static_cast<size_t>(pixels.end) * samples : first + samples;
      for (size_t at = first; at < end; ++at) {
        if (owner_[at] == owner) row[at] = color[i];
      }
    }
  }
}

// Over the colours of the row's samples.
void Film::LayFragments(int32_t y) {
  const size_t row = static_cast<size_t>(tile_.width) * places_.size();
  for (const Fragment& fragment : FragmentsOfRow(y)) {
    const size_t at = fragment.sample % row;
    for (int k = 0; k < 3; ++k) {
      float& color = row_[k][at];
      color = color + (fragment.color[k] - color) * fragment.opacity;
    }
    float& alpha = row_[3][at];
    alpha = alpha + (1 - alpha) * fragment.opacity;
  }
}

// Pixels of which each sample may see something else.
void Film::FillSamples(int32_t y, Span pixels, const TileBuffer* drawn, float* out) {
  FindOwners(y, pixels, drawn);
  for (const uint32_t owner : present_) {
    Collect(y, pixels, owner, drawn);
    passes_.Run({*setup_, setup_->exposure, drawn, owner, y}, &hits_);
    Scatter(pixels, owner);
  }
  const auto samples = static_cast<int32_t>(places_.size());
  const auto channels = static_cast<int32_t>(setup_->channels());
  for (int32_t at = pixels.first * samples; channels == 4 && at < pixels.end * samples; ++at) {
    row_[3][static_cast<size_t>(at)] =
        owner_[static_cast<size_t>(at)] == setup_->sky_owner ? 0.f : 1.f;
  }
  LayFragments(y);
  const float share = 1.f / static_cast<float>(samples);
  for (int k = 0; k < channels; ++k) {
    const float* from = row_[k].data() + pixels.first * samples;
    for (int32_t x = pixels.first; x < pixels.end; ++x, from += samples) {
      float sum = from[0];
      for (int32_t s = 1; s < samples; ++s) sum += from[s];
      out[channels * x + k] = sum * share;
    }
  }
}

void Film::DevelopRow(int32_t y, const TileBuffer* drawn, float* out) {
  const std::optional<uint32_t> behind = BehindRow(y);
  Span mixed = {0, 0};
  if (!behind) {
    mixed = {0, tile_.width};
  } else if (drawn != nullptr) {
    mixed = DrawnPixels(*drawn, y);
  }
  if (mixed.first >= mixed.end) mixed = {0, 0};
  if (const auto laid = FragmentsOfRow(y); !laid.empty()) {
    const auto samples = static_cast<uint32_t>(places_.size());
    const uint32_t row = static_cast<uint32_t>(tile_.width) * samples;
    const auto first = static_cast<int32_t>(laid.front().sample % row / samples);
    const auto end = static_cast<int32_t>(laid.back().sample % row / samples) + 1;
    const bool alone = mixed.first == mixed.end;
    mixed = {alone ? first : std::min(mixed.first, first), std::max(mixed.end, end)};
  }
  if (mixed.first > 0) FillPlain(y, {0, mixed.first}, *behind, out);
  if (mixed.first < mixed.end) FillSamples(y, mixed, drawn, out);
  if (mixed.end < tile_.width) FillPlain(y, {mixed.end, tile_.width}, *behind, out);
}

void Film::Develop(const TileBuffer& drawn, std::span<float> pixels) {
  SortFragments(&fragments_);
  const size_t row = static_cast<size_t>(tile_.width) * setup_->channels();
  for (int32_t y = tile_.y; y < tile_.bottom(); ++y) {
    const bool any = y >= drawn.rect().y && y < drawn.rect().bottom();
    DevelopRow(y, any ? &drawn : nullptr, pixels.data() + static_cast<size_t>(y - tile_.y) * row);
  }
}

size_t Film::Bytes() const {
  constexpr size_t kPerHit = 2 * 4 + 6 * 8 + 11 * 4;
  return owner_.capacity() * (4 + 4 * 4) + fragments_.capacity() * sizeof(Fragment) +
         hits_.x.capacity() * kPerHit + passes_.Bytes();
}

}  // namespace fjord
