#include "engine/render/view_plane.h"

#include <limits>

#include "engine/render/rays.h"

namespace fjord {

std::optional<ViewPlane> MakeViewPlane(const View& view, const Vec3& point, const Vec3& normal) {
  const Rays rays = MakeRays(view);
  ViewPlane plane;
  if (view.orthographic) {
    // normal . (origin + x along_x + y along_y - forward depth - point) = 0
    const double along = glm::dot(normal, view.forward);
    if (along == 0) return std::nullopt;
    plane.depth = glm::dot(normal, rays.origin - point) / along;
    plane.along_x = glm::dot(normal, rays.along_x) / along;
    plane.along_y = glm::dot(normal, rays.along_y) / along;
    plane.least = -std::numeric_limits<double>::infinity();
    plane.most = -view.near;
  } else {
    // normal . (eye + (direction + x along_x + y along_y) / depth - point) = 0
    const double away = glm::dot(normal, point - view.eye);
    if (away == 0) return std::nullopt;
    plane.depth = glm::dot(normal, rays.direction) / away;
    plane.along_x = glm::dot(normal, rays.along_x) / away;
    plane.along_y = glm::dot(normal, rays.along_y) / away;
    plane.least = 0;
    plane.most = 1 / view.near;
  }
  const auto size = [](double v) { return v < 0 ? -v : v; };
  plane.rounding = size(plane.along_x) + size(plane.along_y);
  return plane;
}

}  // namespace fjord
