// Vectors are GLM's. Of GLM only types, + - *, dot and cross are used: nothing that calls libm.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace fjord {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Rgb = glm::vec3;  // linear light

// std::sqrt is an IEEE operation (one instruction under -fno-math-errno), not a libm function.
inline double Length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// v / |v|, or `otherwise` where |v| is 0.
inline Vec3 Unit(const Vec3& v, const Vec3& otherwise = Vec3(0)) {
  const double length = Length(v);
  return length > 0 ? v * (1 / length) : otherwise;
}

}  // namespace fjord
