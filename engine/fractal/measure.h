// Measuring fractals: similarity dimension, rulers, boxes, variograms, and the numbers of a shape
// for `fjord measure`. Pure functions of plain values; logarithms are exact:: ones, so that a
// measurement has the same bits everywhere.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

// D of sum r_m^D = 1 (Moran; G6), every r in 0..1 and two of them at least; D in 0..16. nullopt for
// other ratios. N equal ones: log N / log(1/r).
std::optional<double> SimilarityDimension(std::span<const double> ratios);

// Weighted least squares of y over x. 0 where all x are alike.
double Slope(std::span<const double> x, std::span<const double> y, std::span<const double> weight);

// Mean squared increment over `lag`, at multiples of `lag` only when aligned. values.size() > lag.
double Variogram(std::span<const double> values, size_t lag, bool aligned);

// H of evenly spaced values: half the slope of log variogram over log lag, lags 1, 2, 4, 8, 16,
// weighted by the number of increments (aligned ones: the estimator without bias for midpoint
// displacement). nullopt for fewer than 33 values or values that are all alike.
std::optional<double> HurstExponent(std::span<const double> values, bool aligned = true);

// Steps of a pair of dividers of the given opening along a line, from its first point, the last
// step counted by its share. opening > 0; at most 1e8 steps.
double CountSteps(const Polyline& line, double opening);

// D by rulers (S1): minus the slope of log steps over log opening.
double RulerDimension(const Polyline& line, std::span<const double> openings);

// Occupied boxes of a grid with one corner at `origin`.
size_t CountBoxes(std::span<const Vec3> points, double size, const Vec3& origin);

// D by boxes (G3): minus the slope of log boxes over log size, grid at the points' lowest corner.
double BoxDimension(std::span<const Vec3> points, std::span<const double> sizes);

// Points along a line no further than `step` apart, its own points among them. At most 1e8.
std::vector<Vec3> Resample(const Polyline& line, double step);

double LineLength(const Polyline& line);
double MeshArea(const Mesh& mesh);
// Of the inside of a closed mesh wound counter-clockwise seen from outside.
double MeshVolume(const Mesh& mesh);
// Enclosed in the x, y plane, counter-clockwise positive; an open line is closed by its chord.
double LineArea(const Polyline& line);

// Heights z of a mesh over the plane x, y: H from pairs of vertices at distances of up to an eighth
// of its extent. nullopt for fewer than 1000 vertices or a mesh without extent or relief.
std::optional<double> ReliefHurst(const Mesh& mesh);

}  // namespace fjord
