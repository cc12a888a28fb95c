#include "fracture/parameters_colours.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"

namespace windfall::fracture {
namespace {

struct ColourKey {
    const char* name;
    std::vector<double> WoodColours::*member;
    const char* doc;
};

constexpr std::array<ColourKey, 5> kColourKeys{{
    {"pith", &WoodColours::pith, "the pith"},
    {"heartwood", &WoodColours::heartwood, "heartwood"},
    {"sapwood", &WoodColours::sapwood, "sapwood"},
    {"inner_bark", &WoodColours::inner_bark, "the inner bark, which is the phloem"},
    {"bark", &WoodColours::bark, "the bark"},
}};

}  // namespace

void add_colours(ParameterTable<FractureParameters>& table) {
    table.add_choice(
        "colours.wood", [](auto& p) -> auto& { return p.colours.wood; },
        {"species", "plain", "juniperus", "juniperus-chinensis", "ailanthus", "koelreuteria", "oak", "pine",
         "green"},
        "whose wood it looks like; species: that of species.name, a plain pale wood for a custom one");
    for (const ColourKey& key : kColourKeys)
        table.add(std::string("colours.") + key.name,
                  "1", [member = key.member](auto& p) -> auto& { return p.colours.*member; },
                  std::string("colour of ") + key.doc + ": sRGB red, green, blue; []: that of colours.wood",
                  {.minimum = 0, .maximum = 1});
    const auto add_number = [&](const std::string& key, const std::string& unit, double WoodColours::*member,
                                const std::string& doc, double maximum) {
        table.add("colours." + key, unit, [member](auto& p) -> auto& { return p.colours.*member; }, doc,
                  {.minimum = 0, .maximum = maximum});
    };
    add_number("ring_width", "radii", &WoodColours::ring_width,
               "mean width of the annual rings; 0: that of colours.wood", 1);
    add_number("late_wood", "1", &WoodColours::late_wood,
               "how dark the late wood of the rings is, or the pores of oak; 1: as in colours.wood", 3);
    add_number("variation", "1", &WoodColours::variation,
               "how much fibre bundles differ; 1: as in colours.wood", 5);
    add_number("streaks", "1", &WoodColours::streaks,
               "strength of the streaks along the fibres; 1: as in colours.wood", 5);
    add_number("wetness", "1", &WoodColours::wetness,
               "wet wood (species.moisture): how much darker it is, and greener under the bark", 3);
    add_number("weathering", "1", &WoodColours::weathering, "0: freshly broken; 1: grey from the weather", 1);
}

void check_colours(const FractureParameters& parameters) {
    for (const ColourKey& key : kColourKeys)
        if (const auto& colour = parameters.colours.*key.member; !colour.empty() && colour.size() != 3)
            throw InputError(
                fmt::format("colours.{} must have three numbers (red, green, blue), or none for "
                            "the colour of colours.wood, not {}",
                            key.name, colour.size()));
}

}  // namespace windfall::fracture
