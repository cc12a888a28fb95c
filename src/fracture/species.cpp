#include "fracture/species.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace windfall::fracture {
namespace {

/// A property that the height law weighs.
struct WeighedProperty {
    const char* key;  // of the recipe
    const char* unit;
    double WoodProperties::*value;
    double weight;
};

constexpr std::array<WeighedProperty, 4> kWeighed{
    {{"species.density_g_cm3", "g/cm3", &WoodProperties::density_g_cm3, 39.5271},
     {"species.bending_strength_mpa", "MPa", &WoodProperties::bending_strength_mpa, -0.2121},
     {"species.bending_modulus_gpa", "GPa", &WoodProperties::bending_modulus_gpa, -0.3708},
     {"species.splitting_strength_kgf_cm", "kgf/cm", &WoodProperties::splitting_strength_kgf_cm, -0.2409}}};

struct MeasuredRange {
    double low, high;
    bool holds(double value) const {
        const double rounding = 1e-3 * (high - low);
        return value >= low - rounding && value <= high + rounding;
    }
};

template <class Value>
MeasuredRange measured_range(const Value& value_of) {
    const auto [low, high] =
        std::minmax_element(measured_woods().begin(), measured_woods().end(),
                            [&](const auto& a, const auto& b) { return value_of(a) < value_of(b); });
    return {value_of(*low), value_of(*high)};
}

/// What lies outside the measurements, as parts of a sentence.
std::vector<std::string> outside_measurements(const WoodProperties& wood) {
    std::vector<std::string> result;
    for (const WeighedProperty& property : kWeighed) {
        const double value = wood.*property.value;
        const auto range =
            measured_range([&](const MeasuredWood& w) { return w.properties.*property.value; });
        if (!range.holds(value))
            result.push_back(fmt::format("{} = {:g} {} (measured: {:g} .. {:g})", property.key, value,
                                         property.unit, range.low, range.high));
    }
    const double height = height_law(wood);
    const auto heights = measured_range([](const MeasuredWood& w) { return w.measured_height; });
    if (!heights.holds(height))
        result.push_back(fmt::format("a height of {:.2f} radii (measured: {:.2f} .. {:.2f})", height,
                                     heights.low, heights.high));
    return result;
}

std::string warning_of(const std::vector<std::string>& outside, double law, double used) {
    std::string what = outside.front();
    for (std::size_t i = 1; i < outside.size(); ++i) what += ", " + outside[i];
    std::string text = "The height law was fitted to four woods, and this one lies outside them: " + what +
                       ". There it is a guess";
    if (used != law) text += fmt::format("; the break gets {:.2f} radii in place of {:.2f}", used, law);
    return text + ". To choose the height, set break.height_from = asked and break.mean_height.";
}

}  // namespace

const std::vector<MeasuredWood>& measured_woods() {
    static const std::vector<MeasuredWood> woods{
        {SpeciesName::Juniperus,
         "juniper",
         "Juniperus virginiana / rigida",  // the first in the paper's Table 1, the second in its text
         {0.53, 0.031, 0.047, 25.0, 49.0, 4.6, 4003, 9.0},
         6.6835},
        {SpeciesName::JuniperusChinensis,
         "Chinese juniper",
         "Juniperus chinensis",
         {0.61, 0.0242, 0.0324, 46.8, 77.6, 8.13, 6252, 6.7},
         3.025},
        {SpeciesName::Ailanthus,
         "tree of heaven",
         "Ailanthus altissima",
         {0.67, 0.016, 0.049, 37.6, 81.3, 10.5, 5374, 19.1},
         0.7462},
        {SpeciesName::Koelreuteria,
         "golden rain tree",
         "Koelreuteria paniculata",
         {0.78, 0.033, 0.053, 37.6, 97.8, 11.4, 7286, 22.0},
         0.5625}};
    return woods;
}

const MeasuredWood* measured_wood(SpeciesName name) {
    for (const MeasuredWood& wood : measured_woods())
        if (wood.name == name) return &wood;
    return nullptr;
}

WoodProperties wood_properties(const SpeciesParameters& species) {
    if (const MeasuredWood* wood = measured_wood(species.name)) return wood->properties;
    WoodProperties wood;
    wood.density_g_cm3 = species.density_g_cm3;
    wood.shrinkage_radial = species.shrinkage_radial;
    wood.shrinkage_tangential = species.shrinkage_tangential;
    wood.bending_strength_mpa = species.bending_strength_mpa;
    wood.bending_modulus_gpa = species.bending_modulus_gpa;
    wood.splitting_strength_kgf_cm = species.splitting_strength_kgf_cm;
    return wood;
}

double height_law(const WoodProperties& wood) {
    double height = 0;
    for (const WeighedProperty& property : kWeighed) height += property.weight * wood.*property.value;
    return height;
}

MoistureEffect moisture_effect(Moisture moisture) {
    if (moisture == Moisture::Dry) return {};
    return {.fibre_length = 1.6, .crack_count = 0.25, .crack_width = 0.35, .crack_depth = 0.5};
}

double asked_mean_height(const FractureParameters& parameters, std::vector<std::string>* warnings) {
    const WoodProperties wood = wood_properties(parameters.species);
    const double law = height_law(wood);
    const double used = std::clamp(law, kLeastHeight, kLargestHeight);
    const auto outside = outside_measurements(wood);
    if (warnings != nullptr && !outside.empty()) warnings->push_back(warning_of(outside, law, used));
    return used * moisture_effect(parameters.species.moisture).fibre_length;
}

}  // namespace windfall::fracture
