#include "engine/render/film.h"

#include <algorithm>
#include <cmath>

namespace fjord {
namespace {

// Owners of samples beside objects.
constexpr uint32_t kBackground = 0xffffffff;
constexpr uint32_t kSea = 0xfffffffe;
constexpr uint32_t kDone = 0xfffffffd;

// Light thrown back by still water at the cosine c of the angle of sight (Schlick).
float Fresnel(float c) {
  const float m = 1 - c;
  const float m2 = m * m;
  return .02f + .98f * (m2 * m2 * m);
}

}  // namespace

Rgb Film::Background(int32_t y) const {
  const double t = (y + .5) / setup_.frame.height;
  const Rgb& top = setup_.frame.background_top;
  return top + (setup_.frame.background_bottom - top) * static_cast<float>(t);
}

// The sea is compared here, per sample, with what was drawn.
void Film::FindOwners(TileBuffer* tile, int32_t y) {
  const TileRect& rect = tile->rect();
  const size_t width = static_cast<size_t>(rect.width);
  for (size_t s = 0; s < tile->places().size(); ++s) {
    const size_t row = tile->Index(rect.x, y, static_cast<int32_t>(s));
    const uint32_t* hit = tile->hit() + row;
    double* depth = tile->depth() + row;
    uint32_t* owner = owner_.data() + s * width;
    for (size_t x = 0; x < width; ++x) {
      owner[x] = hit[x] == kNoHit ? kBackground : tile->record(hit[x]).object;
    }
    if (!setup_.sea) continue;
    const ViewPlane& sea = *setup_.sea;
    const double sample_y = static_cast<double>(y * kFixedOne + tile->places()[s].y);
    for (size_t x = 0; x < width; ++x) {
      const int32_t pixel = rect.x + static_cast<int32_t>(x);
      const double at =
          sea.At(static_cast<double>(pixel * kFixedOne + tile->places()[s].x), sample_y);
      if (!sea.Seen(at) || !(at - sea.rounding > depth[x])) continue;
      owner[x] = kSea;
      depth[x] = at;
    }
  }
}

void Film::CollectHits(TileBuffer* tile, int32_t y, uint32_t owner) {
  const TileRect& rect = tile->rect();
  const size_t width = static_cast<size_t>(rect.width);
  const size_t count = width * tile->places().size();
  hits_.Resize(count);
  hit_of_.resize(count);
  size_t size = 0;
  for (size_t s = 0; s < tile->places().size(); ++s) {
    const size_t row = tile->Index(rect.x, y, static_cast<int32_t>(s));
    const SamplePlace& place = tile->places()[s];
    const double sample_y = static_cast<double>(y * kFixedOne + place.y);
    for (size_t x = 0; x < width; ++x) {
      const size_t at = s * width + x;
      if (owner_[at] != owner) continue;
      owner_[at] = kDone;
      const int32_t pixel = rect.x + static_cast<int32_t>(x);
      hits_.place[size] = static_cast<uint32_t>(at);
      hits_.x[size] = static_cast<double>(pixel * kFixedOne + place.x);
      hits_.y[size] = sample_y;
      hits_.depth[size] = tile->depth()[row + x];
      hit_of_[size] = tile->hit()[row + x];
      ++size;
    }
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
  const BuiltObject& built = setup_.frame.objects[object];
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
  const ObjectSetup& setup = setup_.objects[object];
  const Material& material = setup_.frame.objects[object].material;
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
  Illuminate(setup.surface, setup_.lights, &hits_);
}

// Lit like a surface; towards the horizon more and more of the sky is thrown back, until sea and
// background meet without a line.
void Film::ShadeSea(const Rgb& background) {
  const Rgb& top = setup_.frame.background_top;
  for (int k = 0; k < 3; ++k) {
    std::fill_n(hits_.normal[k].begin(), hits_.size, k == 2 ? 1.f : 0.f);
    std::fill_n(hits_.color[k].begin(), hits_.size, setup_.frame.sea->color[k]);
  }
  LocateHits(setup_.sea_geometry, &hits_);
  Illuminate(setup_.sea_surface, setup_.lights, &hits_);
  for (size_t i = 0; i < hits_.size; ++i) {
    const float vx = hits_.to_eye[0][i], vy = hits_.to_eye[1][i], vz = hits_.to_eye[2][i];
    const float length = std::sqrt(vx * vx + vy * vy + vz * vz);
    const float c = (vz < 0 ? -vz : vz) / length;
    const float thrown_back = Fresnel(c);
    for (int k = 0; k < 3; ++k) {
      const float sky = background[k] + (top[k] - background[k]) * c;
      float& color = hits_.color[k][i];
      color = color + (sky - color) * thrown_back;
    }
  }
}

void Film::Develop(TileBuffer* tile, std::span<float> rgb) {
  const TileRect& rect = tile->rect();
  const size_t width = static_cast<size_t>(rect.width);
  const size_t samples = tile->places().size();
  const size_t count = width * samples;
  owner_.resize(count);
  row_.resize(3 * count);
  const float share = 1.f / static_cast<float>(samples);
  for (int32_t y = rect.y; y < rect.bottom(); ++y) {
    const Rgb background = Background(y);
    FindOwners(tile, y);
    for (size_t at = 0; at < count; ++at) {
      const uint32_t owner = owner_[at];
      if (owner == kDone) continue;
      if (owner == kBackground) {
        for (int k = 0; k < 3; ++k) row_[3 * at + k] = background[k];
        continue;
      }
      CollectHits(tile, y, owner);
      if (owner == kSea) {
        ShadeSea(background);
      } else {
        ShadeObject(*tile, owner);
      }
      for (size_t i = 0; i < hits_.size; ++i) {
        for (int k = 0; k < 3; ++k) row_[3 * hits_.place[i] + k] = hits_.color[k][i];
      }
    }
    float* out = rgb.data() + static_cast<size_t>(y - rect.y) * width * 3;
    for (size_t i = 0; i < 3 * width; ++i) {
      float sum = row_[i];
      for (size_t s = 1; s < samples; ++s) sum += row_[3 * s * width + i];
      out[i] = sum * share;
    }
  }
}

size_t Film::Bytes() const {
  return owner_.capacity() * 4 + hit_of_.capacity() * 4 + row_.capacity() * 4 +
         hits_.x.capacity() * (3 * 8 + 4 + 10 * 4 + 3 * 8) +
         texture_.capacity() * sizeof(SurfaceSample);
}

}  // namespace fjord
