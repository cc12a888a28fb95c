#pragma once
// What a recipe of drying names by files: an artist's mesh, and a stone for it.
#include <memory>
#include <optional>

#include "drying/artist_fruit.h"

namespace windfall::recipe {

/// The meshes that the parameters name, read and found to be closed; nothing where the fruit is given by its
/// ten numbers. Throws InputError with the key, the file and the places of what is wrong, and where the fruit
/// is too thin for its skin.
std::optional<drying::ArtistMeshes> read_meshes(const drying::DryingParameters& parameters);

/// The fruit made of them; null where there is no mesh.
std::unique_ptr<const drying::ArtistFruit> read_fruit(const drying::DryingParameters& parameters);

/// Real length of r_1 (m).
double real_r1_m(const drying::DryingParameters& parameters);

}  // namespace windfall::recipe
