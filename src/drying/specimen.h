#pragma once
// From the parameters of a fruit to the solid mesh that is solved on.
#include <memory>

#include "drying/artist_fruit.h"
#include "drying/parameters.h"
#include "geometry/fruit_shape.h"
#include "geometry/layered_mesh.h"

namespace windfall::drying {

/// The fruit's shape; throws InputError where the ten numbers make none, std::logic_error for an artist's
/// mesh.
std::unique_ptr<geometry::FruitShape> make_shape(const FruitParameters& fruit);

/// How the fruit is meshed once the parameters that are 0 ("choose for me") have been chosen.
struct MeshPlan {
    geometry::Lattice cells{};
    int layers = 0;
    int skin_layers = 0;
    double growth = 1;
};
MeshPlan plan_mesh(const DryingParameters& parameters, const geometry::FruitShape& shape);

MeshPlan plan_mesh(const DryingParameters& parameters, const ArtistFruit& fruit);

/// Mean edge that elements on the skin should have, in r_1.
double wanted_edge(const DryingParameters& parameters);

/// The fresh fruit without imperfection.
geometry::LayeredMesh make_mesh(const DryingParameters& parameters, const geometry::FruitShape& shape);
/// The same of an artist's mesh, whose surface is the skin's outer one. Throws InputError with the place
/// where its layers fold over.
geometry::LayeredMesh make_mesh(const DryingParameters& parameters, const ArtistFruit& fruit);

/// Wave length of wrinkles of a film on a soft half space, 2 pi t_e (gamma / 3)^(1/3), in r_1.
double expected_wave_length(const DryingParameters& parameters);

/// Shrinkage at which they are expected: the film's critical strain (1/4) (3 / gamma)^(2/3), over 1.5 since a
/// fruit's skin is pressed in both directions.
double expected_onset(const DryingParameters& parameters);

/// The two shrinkages between whose tangents buckling is linearised (see buckling_modes.h).
struct BucklingLinearization {
    double at = 0;
    double beyond = 0;
};
BucklingLinearization buckling_linearization(const DryingParameters& parameters);

}  // namespace windfall::drying
