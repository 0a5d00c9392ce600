#include "engine/render/film.h"

#include <algorithm>

namespace fjord {
namespace {

// Owners of samples beside objects.
constexpr uint32_t kBackground = 0xffffffff;
constexpr uint32_t kSea = 0xfffffffe;
constexpr uint32_t kDone = 0xfffffffd;

}  // namespace

Rgb Film::Background(int32_t y) const {
  const double t = (y + .5) / setup_->frame.height;
  const Rgb& top = setup_->frame.background_top;
  return top + (setup_->frame.background_bottom - top) * static_cast<float>(t);
}

void Film::StartTile(const TileBuffer& tile) {
  const size_t samples = tile.places().size();
  const size_t count = static_cast<size_t>(tile.rect().width) * samples;
  // SIMD lanes may read past the end
  constexpr size_t kPadding = 64;
  owner_.resize(count + kPadding);
  sample_x_.resize(count + kPadding);
  sample_y_.resize(count + kPadding);
  for (auto& channel : row_) channel.resize(count + kPadding);
  for (size_t at = 0; at < count; ++at) {
    const int32_t pixel = tile.rect().x + static_cast<int32_t>(at / samples);
    sample_x_[at] = static_cast<double>(pixel * kFixedOne + tile.places()[at % samples].x);
    sample_y_[at] = static_cast<double>(tile.places()[at % samples].y);
  }
}

// The sea is compared here, per sample, with what was drawn.
Film::RowContent Film::FindOwners(TileBuffer* tile, int32_t y) {
  const size_t row = tile->Index(tile->rect().x, y, 0);
  const size_t count = static_cast<size_t>(tile->rect().width) * tile->places().size();
  const uint32_t* hit = tile->hit() + row;
  RowContent content;
  size_t hits = 0;
  for (size_t at = 0; at < count; ++at) {
    const bool any = hit[at] != kNoHit;
    owner_[at] = any ? tile->record(hit[at]).object : kBackground;
    hits += any ? 1 : 0;
  }
  content.objects = hits > 0;
  content.background = hits < count;
  if (setup_->sea) {
    const size_t wet = FindSea(*setup_->sea, sample_x_.data(), sample_y_.data(),
                               static_cast<double>(y * kFixedOne), count, kSea, tile->depth() + row,
                               owner_.data());
    content.sea = wet > 0;
    if (wet == count) content.objects = content.background = false;
  }
  return content;
}

// All samples of the row that have the owner of `first`; they are marked as done.
void Film::CollectHits(TileBuffer* tile, int32_t y, size_t first) {
  const size_t row = tile->Index(tile->rect().x, y, 0);
  const size_t count = static_cast<size_t>(tile->rect().width) * tile->places().size();
  const double top = static_cast<double>(y * kFixedOne);
  const uint32_t owner = owner_[first];
  hits_.Resize(count);
  hit_of_.resize(count);
  size_t size = 0;
  for (size_t at = first; at < count; ++at) {
    if (owner_[at] != owner) continue;
    owner_[at] = kDone;
    hits_.place[size] = static_cast<uint32_t>(at);
    hits_.x[size] = sample_x_[at];
    hits_.y[size] = top + sample_y_[at];
    hits_.depth[size] = tile->depth()[row + at];
    hit_of_[size] = tile->hit()[row + at];
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
  const BuiltObject& built = setup_->frame.objects[object];
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
  const Material& material = setup_->frame.objects[object].material;
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

// Lit like a surface; towards the horizon more and more of the sky is thrown back, until sea and
// background meet without a line. The sea is smooth, so one light a pixel does for all its samples.
void Film::ShadeSea(TileBuffer* tile, int32_t y, const Rgb& background) {
  const size_t samples = tile->places().size();
  const size_t width = static_cast<size_t>(tile->rect().width);
  const double* depth = tile->depth() + tile->Index(tile->rect().x, y, 0);
  sea_.Resize(width);
  size_t size = 0;
  for (size_t x = 0; x < width; ++x) {
    size_t s = 0;
    while (s < samples && owner_[x * samples + s] != kSea) ++s;
    if (s == samples) continue;
    constexpr int32_t kHalf = kFixedOne / 2;  // a pixel's middle
    const int32_t pixel = tile->rect().x + static_cast<int32_t>(x);
    sea_.place[size] = static_cast<uint32_t>(x);
    sea_.x[size] = static_cast<double>(pixel * kFixedOne + kHalf);
    sea_.y[size] = static_cast<double>(y * kFixedOne + kHalf);
    sea_.depth[size] = depth[x * samples + s];  // that of the middle may lie beyond the horizon
    ++size;
  }
  sea_.Resize(size);
  for (int k = 0; k < 3; ++k) {
    std::fill_n(sea_.normal[k].begin(), size, k == 2 ? 1.f : 0.f);
    std::fill_n(sea_.color[k].begin(), size, setup_->frame.sea->color[k]);
  }
  LocateHits(setup_->sea_geometry, &sea_);
  Illuminate(setup_->sea_surface, setup_->lights, &sea_);
  ReflectSky(background, setup_->frame.background_top, &sea_);
  for (size_t i = 0; i < size; ++i) {
    const size_t first = sea_.place[i] * samples;
    for (size_t at = first; at < first + samples; ++at) {
      if (owner_[at] != kSea) continue;
      for (int k = 0; k < 3; ++k) row_[k][at] = sea_.color[k][i];
    }
  }
}

void Film::Develop(const FrameSetup& setup, TileBuffer* tile, std::span<float> rgb) {
  setup_ = &setup;
  const TileRect& rect = tile->rect();
  const size_t width = static_cast<size_t>(rect.width);
  const size_t samples = tile->places().size();
  const size_t count = width * samples;
  StartTile(*tile);
  const float share = 1.f / static_cast<float>(samples);
  for (int32_t y = rect.y; y < rect.bottom(); ++y) {
    const Rgb background = Background(y);
    const RowContent content = FindOwners(tile, y);
    if (content.background) {
      for (int k = 0; k < 3; ++k) std::fill_n(row_[k].begin(), count, background[k]);
    }
    if (content.sea) ShadeSea(tile, y, background);
    for (size_t at = 0; content.objects && at < count; ++at) {
      const uint32_t owner = owner_[at];
      if (owner >= kDone) continue;
      CollectHits(tile, y, at);
      ShadeObject(*tile, owner);
      for (int k = 0; k < 3; ++k) {
        for (size_t i = 0; i < hits_.size; ++i) row_[k][hits_.place[i]] = hits_.color[k][i];
      }
    }
    float* out = rgb.data() + static_cast<size_t>(y - rect.y) * width * 3;
    for (int k = 0; k < 3; ++k) {
      const float* from = row_[k].data();
      for (size_t x = 0; x < width; ++x) {
        float sum = from[x * samples];
        for (size_t s = 1; s < samples; ++s) sum += from[x * samples + s];
        out[3 * x + k] = sum * share;
      }
    }
  }
}

size_t Film::Bytes() const {
  constexpr size_t kPerHit = 4 + 6 * 8 + 10 * 4;
  return owner_.capacity() * (4 + 2 * 8 + 3 * 4) + hit_of_.capacity() * 4 +
         (hits_.x.capacity() + sea_.x.capacity()) * kPerHit +
         texture_.capacity() * sizeof(SurfaceSample);
}

}  // namespace fjord
