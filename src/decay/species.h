#pragma once
// Organisms that spoil fruit: between which temperatures and water activities they grow, and what they look
// like.
#include <array>
#include <string>
#include <vector>

namespace windfall::decay {

/// The least, best and largest value of a condition under which an organism grows.
struct CardinalValues {
    double minimum = 0, optimum = 0, maximum = 0;
};

/// Rosso's cardinal model with inflection (L. Rosso, J. R. Lobry, J. P. Flandrois, J. Theor. Biol. 162, 1993;
/// for moulds L. Rosso and T. P. Robinson, Int. J. Food Microbiol. 63, 2001): growth rate over the best,
/// 0..1; 0 outside minimum .. maximum.
double cardinal_growth(const CardinalValues& values, double x);

/// Soft rot comes first and opens the skin; a fungus lives in it (Kider, Raja, Badler 2011, section 4.3).
enum class OrganismKind { SoftRot, Fungus };

/// An organism as the literature knows it.
struct Species {
    std::string name;         ///< as in a recipe: "penicillium-digitatum"
    std::string common_name;  ///< "green mould"
    OrganismKind kind = OrganismKind::Fungus;
    CardinalValues temperature_c;
    CardinalValues
        water_activity;  ///< the maximum stands just above 1, so that free water does not stop growth
    std::string source;  ///< of the cardinal values; says which of them are assumed
};

const std::vector<Species>& species();
/// Throws InputError, with the nearest name, where there is none.
const Species& species_named(const std::string& name);

}  // namespace windfall::decay
