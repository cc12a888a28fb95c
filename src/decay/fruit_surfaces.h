#pragma once
// Shapes of the fruit that rot: unit directions to points of the skin, z up along the fruit's axis.
#include "decay/body.h"

namespace windfall::decay {

enum class FruitKind { Tomato, Apple, Orange, Peach, Pear, Ball, Mesh };

/// Density of fresh fruit (kg/m3): most float or just sink.
inline constexpr double kFruitDensity_kg_m3 = 1000;

/// A fruit of that mass at kFruitDensity_kg_m3, about its middle. Proportions by eye of shop fruit: an apple
/// is 0.9 as high as it is wide, a tomato 0.75, an orange 0.97, a peach 0.95, a pear 1.35. Throws
/// std::logic_error for Mesh, whose shape comes from a file.
SurfaceFunction fruit_surface(FruitKind kind, double mass_kg);

/// Volume (m3) inside a surface that is sampled on the sides of a cube with `cells` cells along an edge.
double surface_volume(const SurfaceFunction& surface, int cells = 32);

/// The surface as many times as large.
SurfaceFunction scaled(const SurfaceFunction& surface, double factor);

}  // namespace windfall::decay
