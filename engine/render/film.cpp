#include "engine/render/film.h"

#include <algorithm>
#include <limits>

namespace fjord {
namespace {

// Owners of samples beside objects.
constexpr uint32_t kBackground = 0xffffffff;
constexpr uint32_t kSea = 0xfffffffe;
constexpr uint32_t kDone = 0xfffffffd;

// Are these sixteen, which is a whole number of pixels, all without a hit? It has all bits set.
bool NoneHit(const uint32_t* hit) {
  uint32_t all = kNoHit;
  for (int i = 0; i < 16; ++i) all &= hit[i];
  return all == kNoHit;
}

}  // namespace

Rgb Film::Background(int32_t y) const {
  const double t = (y + .5) / setup_->frame.height;
  const Rgb& top = setup_->frame.background_top;
  return top + (setup_->frame.background_bottom - top) * static_cast<float>(t);
}

void Film::StartTile(const TileRect& tile) {
  tile_ = tile;
  places_ = SamplePlaces(setup_->frame.samples);
  const size_t count = static_cast<size_t>(tile.width) * places_.size();
  constexpr size_t kPadding = 64;  // SIMD lanes may read past the end
  owner_.resize(count + kPadding);
  for (auto& channel : row_) channel.resize(count + kPadding);
}

// The plane's depth at a sample of pixel x of the tile.
double Film::SeaDepth(int32_t x, int32_t y, const SamplePlace& place) const {
  return setup_->sea->At(static_cast<double>((tile_.x + x) * kFixedOne + place.x),
                         static_cast<double>(y * kFixedOne + place.y));
}

// What the samples of a row see where nothing was drawn. Rounded sums and products are monotone, so
// the corners of the row's box speak for all that lies between.
Film::Behind Film::BehindRow(int32_t y) const {
  if (!setup_->sea) return Behind::kBackground;
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
  if (sea.Seen(least) && sea.Seen(most)) return Behind::kSea;
  return most <= sea.least || least > sea.most ? Behind::kBackground : Behind::kBoth;
}

Film::Span Film::DrawnPixels(const TileBuffer& drawn, int32_t y) const {
  const auto samples = static_cast<int32_t>(places_.size());
  const uint32_t* hit = drawn.hit() + drawn.Index(tile_.x, y, 0);
  int32_t first = 0, end = tile_.width * samples;
  while (end - first >= 16 && NoneHit(hit + first)) first += 16;
  while (end - first >= 16 && NoneHit(hit + end - 16)) end -= 16;
  return {first / samples, (end + samples - 1) / samples};
}

// Pixels whose samples all see the same.
void Film::FillPlain(int32_t y, Span pixels, Behind behind, float* out) {
  const size_t samples = places_.size();
  const float share = 1.f / static_cast<float>(samples);
  const auto average = [&](float color) {
    float sum = color;
    for (size_t s = 1; s < samples; ++s) sum += color;
    return sum * share;
  };
  if (behind == Behind::kBackground) {
    for (int k = 0; k < 3; ++k) {
      const float color = average(background_[k]);
      for (int32_t x = pixels.first; x < pixels.end; ++x) out[3 * x + k] = color;
    }
    return;
  }
  sea_.Resize(static_cast<size_t>(pixels.end - pixels.first));
  sea_.size = 0;
  for (int32_t x = pixels.first; x < pixels.end; ++x) {
    AddSeaPixel(x, y, SeaDepth(x, y, places_[0]));
  }
  ShadeSea();
  for (int k = 0; k < 3; ++k) {
    const float* color = sea_.color[k].data();
    for (int32_t x = pixels.first; x < pixels.end; ++x) {
      out[3 * x + k] = average(color[x - pixels.first]);
    }
  }
}

// The sea was laid under everything else before it was drawn: where no hit is, it shows.
void Film::FindOwners(int32_t y, Span pixels, const TileBuffer* drawn) {
  const uint32_t* hit = drawn != nullptr ? drawn->hit() + drawn->Index(tile_.x, y, 0) : nullptr;
  const bool one = setup_->objects.size() == 1;
  sea_.Resize(static_cast<size_t>(pixels.end - pixels.first));
  sea_.size = 0;
  size_t at = static_cast<size_t>(pixels.first) * places_.size();
  for (int32_t x = pixels.first; x < pixels.end; ++x) {
    bool wet = false;
    for (const SamplePlace& place : places_) {
      uint32_t& owner = owner_[at];
      if (hit != nullptr && hit[at] != kNoHit) {
        owner = one ? 0 : drawn->record(hit[at]).object;
      } else {
        const double depth = setup_->sea ? SeaDepth(x, y, place) : 0;
        owner = setup_->sea && setup_->sea->Seen(depth) ? kSea : kBackground;
        if (owner == kSea && !wet) AddSeaPixel(x, y, depth);
        wet |= owner == kSea;
      }
      ++at;
    }
  }
}

// All samples that have the owner of `first`; they are marked as done.
void Film::CollectHits(const TileBuffer& drawn, int32_t y, Span samples, int32_t first) {
  const size_t row = drawn.Index(tile_.x, y, 0);
  const double top = static_cast<double>(y * kFixedOne);
  const uint32_t owner = owner_[static_cast<size_t>(first)];
  hits_.Resize(static_cast<size_t>(samples.end - first));
  hit_of_.resize(static_cast<size_t>(samples.end - first));
  size_t size = 0;
  for (size_t at = static_cast<size_t>(first); at < static_cast<size_t>(samples.end); ++at) {
    if (owner_[at] != owner) continue;
    owner_[at] = kDone;
    hits_.place[size] = static_cast<uint32_t>(at);
    hits_.x[size] = drawn.sample_x()[at];
    hits_.y[size] = top + drawn.sample_y()[at];
    hits_.depth[size] = drawn.depth()[row + at];
    hit_of_[size] = drawn.hit()[row + at];
    __builtin_prefetch(&drawn.record(hit_of_[size]));  // read when the row is complete
    ++size;
  }
  hits_.Resize(size);
}

// Perspective-correct: exact edge functions of the sample as weights, each times its corner's 1 /
// w.
void Film::InterpolateCorners(const TileBuffer& tile, size_t i, uint32_t hit,
                              const Attributes& attributes) {
  const CornerValues& c = tile.corners(tile.record(hit).corners);
  double weight[3];
  for (int k = 0; k < 3; ++k) {
    const int p = (k + 1) % 3, q = (k + 2) % 3;  // the edge opposite corner k
    const double ex = c.x[q] - double{1} * c.x[p], ey = c.y[q] - double{1} * c.y[p];
    const double area = ex * (hits_.y[i] - c.y[p]) - ey * (hits_.x[i] - c.x[p]);
    weight[k] = area * c.weight[k];
  }
  const double inverse = 1 / ((weight[0] + weight[1]) + weight[2]);
  for (double& w : weight) w *= inverse;
  if (attributes.normals) {
    const Vec3 n = (c.normal[0] * weight[0] + c.normal[1] * weight[1]) + c.normal[2] * weight[2];
    for (int k = 0; k < 3; ++k) hits_.normal[k][i] = static_cast<float>(n[k]);
  }
  if (attributes.colors) {
    for (int k = 0; k < 3; ++k) {
      hits_.color[k][i] = static_cast<float>(
          (c.color[0][k] * weight[0] + c.color[1][k] * weight[1]) + c.color[2][k] * weight[2]);
    }
  }
}

void Film::ApplyTexture(uint32_t object) {
  const BuiltObject& built = setup_->frame.objects[setup_->objects[object].object];
  if (!built.texture || built.texture->empty()) return;
  texture_.resize(hits_.size);
  for (size_t i = 0; i < hits_.size; ++i) {
    SurfaceSample& sample = texture_[i];
    sample = SurfaceSample{};
    const Vec3 world(hits_.position[0][i], hits_.position[1][i], hits_.position[2][i]);
    sample.position = ApplyInverse(built.transform, world);
    sample.normal = Unit(Vec3(hits_.normal[0][i], hits_.normal[1][i], hits_.normal[2][i]));
    sample.color = Rgb(hits_.color[0][i], hits_.color[1][i], hits_.color[2][i]);
  }
  built.texture->ApplyGeometric(texture_, 0);
  built.texture->ApplyColor(texture_, 0);
  for (size_t i = 0; i < hits_.size; ++i) {
    for (int k = 0; k < 3; ++k) {
      hits_.normal[k][i] = static_cast<float>(texture_[i].normal[k]);
      hits_.color[k][i] = texture_[i].color[k];
    }
  }
}

void Film::ShadeObject(const TileBuffer& tile, uint32_t object) {
  const ObjectSetup& setup = setup_->objects[object];
  const Material& material = setup_->frame.objects[setup.object].material;
  for (size_t i = 0; i < hits_.size; ++i) {
    const Rgb& normal = tile.record(hit_of_[i]).normal;
    for (int k = 0; k < 3; ++k) hits_.normal[k][i] = normal[k];
  }
  for (int k = 0; k < 3; ++k) {
    std::fill_n(hits_.color[k].begin(), hits_.size, material.color[k]);
  }
  LocateHits(setup.geometry, &hits_);
  if (!material.ramp.empty()) ColorByHeight(material.ramp, &hits_);
  if (setup.attributes.any()) {
    for (size_t i = 0; i < hits_.size; ++i) {
      InterpolateCorners(tile, i, hit_of_[i], setup.attributes);
    }
  }
  ApplyTexture(object);
  Illuminate(setup.surface, setup_->lights, &hits_);
}

void Film::AddSeaPixel(int32_t x, int32_t y, double depth) {
  constexpr int32_t kHalf = kFixedOne / 2;  // a pixel's middle
  const size_t i = sea_.size++;
  sea_.place[i] = static_cast<uint32_t>(x);
  sea_.x[i] = static_cast<double>((tile_.x + x) * kFixedOne + kHalf);
  sea_.y[i] = static_cast<double>(y * kFixedOne + kHalf);
  sea_.depth[i] = depth;  // of its first sample: that of the middle may lie beyond the horizon
}

// Lit like a surface; towards the horizon more and more of the sky is thrown back, until sea and
// background meet without a line. The sea is smooth, so one light a pixel does for all its samples.
void Film::ShadeSea() {
  for (int k = 0; k < 3; ++k) {
    std::fill_n(sea_.normal[k].begin(), sea_.size, k == 2 ? 1.f : 0.f);
    std::fill_n(sea_.color[k].begin(), sea_.size, setup_->frame.sea->color[k]);
  }
  LocateHits(setup_->sea_geometry, &sea_);
  Illuminate(setup_->sea_surface, setup_->lights, &sea_);
  ReflectSky(background_, setup_->frame.background_top, &sea_);
}

// Pixels of which each sample may see something else.
void Film::FillSamples(int32_t y, Span pixels, const TileBuffer* drawn, float* out) {
  const auto per_pixel = static_cast<int32_t>(places_.size());
  const Span samples = {pixels.first * per_pixel, pixels.end * per_pixel};
  FindOwners(y, pixels, drawn);
  if (sea_.size > 0) ShadeSea();
  for (int32_t at = samples.first; at < samples.end; ++at) {
    if (owner_[static_cast<size_t>(at)] != kBackground) continue;
    for (int k = 0; k < 3; ++k) row_[k][static_cast<size_t>(at)] = background_[k];
  }
  for (size_t i = 0; i < sea_.size; ++i) {
    const size_t first = sea_.place[i] * places_.size();
    for (size_t at = first; at < first + places_.size(); ++at) {
      if (owner_[at] != kSea) continue;
      for (int k = 0; k < 3; ++k) row_[k][at] = sea_.color[k][i];
    }
  }
  for (int32_t at = samples.first; drawn != nullptr && at < samples.end; ++at) {
    const uint32_t owner = owner_[static_cast<size_t>(at)];
    if (owner >= kDone) continue;
    CollectHits(*drawn, y, samples, at);
    ShadeObject(*drawn, owner);
    for (int k = 0; k < 3; ++k) {
      for (size_t i = 0; i < hits_.size; ++i) row_[k][hits_.place[i]] = hits_.color[k][i];
    }
  }
  const float share = 1.f / static_cast<float>(per_pixel);
  for (int k = 0; k < 3; ++k) {
    const float* from = row_[k].data() + samples.first;
    for (int32_t x = pixels.first; x < pixels.end; ++x, from += per_pixel) {
      float sum = from[0];
      for (int32_t s = 1; s < per_pixel; ++s) sum += from[s];
      out[3 * x + k] = sum * share;
    }
  }
}

void Film::DevelopRow(int32_t y, const TileBuffer* drawn, float* out) {
  background_ = Background(y);
  const Behind behind = BehindRow(y);
  Span mixed = {0, 0};
  if (behind == Behind::kBoth) {
    mixed = {0, tile_.width};
  } else if (drawn != nullptr) {
    mixed = DrawnPixels(*drawn, y);
  }
  if (mixed.first >= mixed.end) mixed = {0, 0};
  if (mixed.first > 0) FillPlain(y, {0, mixed.first}, behind, out);
  if (mixed.first < mixed.end) FillSamples(y, mixed, drawn, out);
  if (mixed.end < tile_.width) FillPlain(y, {mixed.end, tile_.width}, behind, out);
}

void Film::Develop(const FrameSetup& setup, const TileRect& tile, const TileBuffer& drawn,
                   std::span<float> rgb) {
  setup_ = &setup;
  StartTile(tile);
  for (int32_t y = tile.y; y < tile.bottom(); ++y) {
    const bool any = y >= drawn.rect().y && y < drawn.rect().bottom();
    DevelopRow(y, any ? &drawn : nullptr,
               rgb.data() + static_cast<size_t>(y - tile.y) * static_cast<size_t>(tile.width) * 3);
  }
}

size_t Film::Bytes() const {
  constexpr size_t kPerHit = 4 + 6 * 8 + 10 * 4;
  return owner_.capacity() * (4 + 3 * 4) + hit_of_.capacity() * 4 +
         (hits_.x.capacity() + sea_.x.capacity()) * kPerHit +
         texture_.capacity() * sizeof(SurfaceSample);
}

}  // namespace fjord
