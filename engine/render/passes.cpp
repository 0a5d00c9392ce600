#include "engine/render/passes.h"

#include <algorithm>

#include "engine/render/shadow_share.h"

namespace fjord {
namespace {

void FillColor(const Rgb& color, SurfaceHits* hits) {
  for (int k = 0; k < 3; ++k) std::fill_n(hits->color[k].begin(), hits->size, color[k]);
}

// How much of each light with a shadow map arrives.
void CastShadows(const PassInput& input, SurfaceHits* hits) {
  const Surface& surface = input.setup.owners[input.owner].surface;
  hits->arrives.resize(input.setup.shadows.size());
  hits->Resize(hits->size);
  for (size_t s = 0; s < input.setup.shadows.size(); ++s) {
    ShareOfLight(surface, input.setup.shadows[s], *hits, hits->arrives[s].data());
  }
}

}  // namespace

void Passes::Run(const PassInput& input, SurfaceHits* hits) {
  RunSurface(input, hits);
  RunLight(input, hits);
  RunMedium(input, hits);
}

void Passes::RunSurface(const PassInput& input, SurfaceHits* hits) {
  const BuiltFrame& frame = input.setup.frame;
  const Owner& owner = input.setup.owners[input.owner];
  switch (owner.kind) {
    case OwnerKind::kSky:
      if (frame.alpha) {
        FillColor(Rgb(0), hits);
      } else if (frame.sky.kind == SkyKind::kPicture) {
        FillColor(SkyOfRow(frame.sky, input.row, frame.height), hits);
      } else {
        LocateHits(owner.geometry, hits);
        ColorByDirection(frame.sky, hits);
      }
      return;
    case OwnerKind::kSea:
      for (int k = 0; k < 3; ++k) {
        std::fill_n(hits->normal[k].begin(), hits->size, k == 2 ? 1.f : 0.f);
      }
      FillColor(frame.sea->color, hits);
      LocateHits(owner.geometry, hits);
      return;
    case OwnerKind::kObject:
      break;
  }
  const Material& material = frame.objects[owner.object].material;
  for (size_t i = 0; i < hits->size; ++i) {
    const Rgb& normal = input.drawn->record(hits->record[i]).normal;
    for (int k = 0; k < 3; ++k) hits->normal[k][i] = normal[k];
  }
  FillColor(material.color, hits);
  LocateHits(owner.geometry, hits);
  if (!material.ramp.empty()) ColorByHeight(material.ramp, hits);
  if (owner.attributes) {
    places_.resize(hits->size);
    for (size_t i = 0; i < hits->size; ++i) places_[i] = FindPlace(*input.drawn, *hits, i);
    owner.attributes->Apply(places_, hits);
  }
  RunTexture(input, hits);
}

void Passes::RunTexture(const PassInput& input, SurfaceHits* hits) {
  const Owner& owner = input.setup.owners[input.owner];
  const BuiltObject& built = input.setup.frame.objects[owner.object];
  if (!built.texture || built.texture->empty()) return;
  texture_.resize(hits->size);
  for (size_t i = 0; i < hits->size; ++i) {
    SurfaceSample& sample = texture_[i];
    sample = SurfaceSample{};
    const Vec3 world(hits->position[0][i], hits->position[1][i], hits->position[2][i]);
    sample.position = ApplyInverse(owner.transform, world);
    sample.normal = Unit(Vec3(hits->normal[0][i], hits->normal[1][i], hits->normal[2][i]));
    sample.color = Rgb(hits->color[0][i], hits->color[1][i], hits->color[2][i]);
  }
  if (owner.attributes) owner.attributes->Apply(places_, texture_);
  built.texture->ApplyGeometric(texture_, input.exposure.instant);
  built.texture->ApplyColor(texture_, input.exposure.instant);
  for (size_t i = 0; i < hits->size; ++i) {
    for (int k = 0; k < 3; ++k) {
      hits->normal[k][i] = static_cast<float>(texture_[i].normal[k]);
      hits->color[k][i] = texture_[i].color[k];
    }
  }
}

// The sea is lit like a surface; towards the horizon more and more of the sky is thrown back, until
// sea and sky meet without a line.
void Passes::RunLight(const PassInput& input, SurfaceHits* hits) const {
  const BuiltFrame& frame = input.setup.frame;
  const Owner& owner = input.setup.owners[input.owner];
  if (owner.kind == OwnerKind::kSky) return;
  if (!input.setup.shadows.empty() && owner.surface.lit) CastShadows(input, hits);
  Illuminate(owner.surface, input.setup.lights, hits);
  if (owner.kind != OwnerKind::kSea) return;
  const Rgb horizon = frame.sky.kind == SkyKind::kPicture
                          ? SkyOfRow(frame.sky, input.row, frame.height)
                          : frame.sky.bottom;
  ReflectSky(horizon, frame.sky.top, hits);
}

// The sky is what all air in front of it made it.
void Passes::RunMedium(const PassInput& input, SurfaceHits* hits) const {
  const Owner& owner = input.setup.owners[input.owner];
  if (!input.setup.frame.haze || owner.kind == OwnerKind::kSky) return;
  AddHaze(*input.setup.frame.haze, owner.geometry.orthographic, hits);
}

}  // namespace fjord
