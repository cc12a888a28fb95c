#pragma once
// What the growth of soft rot and fungi on a skin is computed from. Densities are over theta n0, the density
// that all nutrient turned into organism would give, so that they run from 0 to about 1; nutrient is over n0.
#include <span>
#include <string>
#include <vector>

#include "decay/species.h"

namespace windfall::decay {

/// How motility depends on density B and nutrient N. Kawasaki: D0 B N (Mimura et al. 2000); Logistic:
/// D0 B (1 - B/K2) N, Kider et al. 2011 eq. (4) with the carrying capacity in the units of B; Linear: D0, the
/// textbook's constant diffusivity (with GrowthLaw::Logistic a front runs at exactly 2 sqrt(D0 mu)).
enum class MotilityForm { Kawasaki, Logistic, Linear };

/// What an organism eats. MichaelisMenten: mu 2N/(1+N) B, Kider et al. eq. (7) with f1 = f2 = 1; Logistic: mu
/// N B, which with all of B active and no diffusion of nutrient is the logistic law where B + N = 1.
enum class GrowthLaw { MichaelisMenten, Logistic };

/// One organism with its rates at its best temperature and water activity.
struct Organism {
    Species species;
    MotilityForm form = MotilityForm::Kawasaki;
    GrowthLaw law = GrowthLaw::MichaelisMenten;
    double motility_m2_h = 3.7e-7;  ///< D0; a front's speed grows with its square root
    double growth_per_h = 0.125;    ///< mu: the paper's theta sigma2 / 2
    double capacity = 1.2;          ///< K2 of the logistic form
    /// The organism stops growing where active + inactive reach this; infinite for fungi. Soft rot without it
    /// eats all nutrient, and no fungus comes.
    double crowding = 1e30;
    double ageing_per_h = 5;       ///< sigma3 of a(u, n), eq. (8): active turns into inactive
    double ageing_density = 120;   ///< theta n0 / a1: crowded organisms age more slowly ...
    double ageing_nutrient = 120;  ///< n0 / a2: ... and so do well-fed ones
};

/// Soft rot and fungus with the rates that look right (two to three mm a day); see the reference pictures.
Organism soft_rot_organism(const Species& species);
Organism fungus_organism(const Species& species);

struct GrowthSettings {
    double nutrient_motility_m2_h = 2.45e-8;  ///< Dn
    double nutrient_level = 1;        ///< mean nutrient at the start, over n0; below 0.25 colonies die
    double nutrient_noise = 0.15;     ///< amplitude of the random initial field, 0..1
    double nutrient_noise_m = 0.004;  ///< length of that noise
    double motility_noise =
        0.6;  ///< frozen noise of the motility, 0..1: edges are irregular where it is not 0
    double motility_noise_m = 0.0025;  ///< its length
    /// Range of delta, eq. (5), drawn anew per texel and step: sigma1' = sigma1 (1 + delta), |delta| <= this,
    /// 0..1.
    double step_noise = 0.5;
    double gate_closed = 0.02;  ///< soft-rot density below which no fungus enters ...
    double gate_open = 0.1;     ///< ... and from which on it enters freely
    /// Soft-rot density from which sap wets the skin, so that dry air stops thin beginnings only, and that
    /// from which it is as wet as inside.
    double sap_begins = 0.002, sap_full = 0.02;
    double longest_step_h = 0.5;
};

/// The moment's conditions, the same all over the skin.
struct GrowthConditions {
    double temperature_c = 22;
    double water_activity_skin = 0.5;     ///< on intact, dry skin: the relative humidity of the air
    double water_activity_inside = 0.98;  ///< in rot, in wounds and where the skin is wet
};

/// Fields that may differ from texel to texel; each empty or one value a texel of the atlas.
struct GrowthFields {
    std::span<const float> wetness;   ///< 0 intact dry skin .. 1 as wet as a wound (contacts, the stem scar)
    std::span<const float> nutrient;  ///< factor on the initial nutrient
};

/// Throws InputError, naming the setting, for values that make no growth: negative rates, noise outside 0..1.
void check(const std::vector<Organism>& organisms, const GrowthSettings& settings);

}  // namespace windfall::decay
