// Colours of colonies as in photographs and descriptions: P. digitatum olive green with a broad white rim, P.
// expansum blue-green in tufts (Pitt and Hocking, "Fungi and Food Spoilage", 3rd ed. 2009,
// doi:10.1007/978-0-387-92207-2); Rhizopus white, then grey with black heads on 5 to 15 mm stalks; Botrytis
// grey-brown; Neofabraea cream to pale brown; soft-rot bacteria without any mycelium. The numbers are chosen
// by eye.
#include "decay/rot_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace windfall::decay {
namespace {

LinearColour typed(double red, double green, double blue) {
    return linear_from_typed(Eigen::Vector3d(red, green, blue));
}

std::vector<MoldLook> make_molds() {
    std::vector<MoldLook> molds;
    molds.push_back({"digitatum",
                     typed(0.93, 0.93, 0.90),
                     typed(0.47, 0.52, 0.36),
                     typed(0.38, 0.41, 0.30),
                     1,
                     3e-4F,
                     {4e-4F, 2.5e-4F, 1.2e-5F, 0.5F, 0, 0, 0}});
    molds.push_back({"expansum",
                     typed(0.93, 0.94, 0.92),
                     typed(0.36, 0.52, 0.50),
                     typed(0.34, 0.42, 0.39),
                     1,
                     4e-4F,
                     {5e-4F, 5e-4F, 1.4e-5F, 0.5F, 0.02F, 1.2e-3F, 0}});
    molds.push_back({"rhizopus",
                     typed(0.93, 0.93, 0.91),
                     typed(0.66, 0.66, 0.64),
                     typed(0.36, 0.35, 0.34),
                     0.6F,
                     2e-4F,
                     {1.5e-3F, 3e-3F, 1.2e-5F, 1.4F, 0.05F, 13e-3F, 1.1e-4F}});
    molds.push_back({"neofabraea",
                     typed(0.86, 0.80, 0.70),
                     typed(0.74, 0.62, 0.47),
                     typed(0.52, 0.40, 0.28),
                     0.7F,
                     1.5e-4F,
                     {1.5e-4F, 1.5e-4F, 1.2e-5F, 0.4F, 0, 0, 0}});
    molds.push_back({"botrytis",
                     typed(0.90, 0.90, 0.88),
                     typed(0.58, 0.55, 0.51),
                     typed(0.46, 0.42, 0.37),
                     0.9F,
                     3e-4F,
                     {1e-3F, 1.6e-3F, 1.2e-5F, 0.7F, 0.05F, 3e-3F, 0}});
    molds.push_back({"erwinia", typed(1, 1, 1), typed(1, 1, 1), typed(1, 1, 1), 0, 0, {}});
    return molds;
}

const std::vector<MoldLook>& molds() {
    static const std::vector<MoldLook> all = make_molds();
    return all;
}

MoldLook plain_mold() {
    MoldLook look = molds()[4];
    look.key = "mold";
    return look;
}

// Calls visit(key, member, low, high) for each.
template <class Look, class Visit>
void for_each_member(Look& look, const Visit& visit) {
    visit("fresh_colour", look.fresh_colour, 0.0, 1.0);
    visit("blush_colour", look.blush_colour, 0.0, 1.0);
    visit("blush", look.blush, 0.0, 1.0);
    visit("streaks", look.streaks, 0.0, 1.0);
    visit("mottle", look.mottle, 0.0, 1.0);
    visit("mottle_scale_m", look.mottle_scale_m, 1e-5, 10.0);
    visit("roughness", look.roughness, 0.05, 1.0);
    visit("soaked_colour", look.soaked_colour, 0.0, 1.0);
    visit("rot_colour", look.rot_colour, 0.0, 1.0);
    visit("old_rot_colour", look.old_rot_colour, 0.0, 1.0);
    visit("full_rot", look.full_rot, 0.01, 1.0);
}

[[noreturn]] void bad_value(const std::string& key, const nlohmann::json& value, const std::string& wanted) {
    throw InputError(fmt::format("{}: {} is not {}; make the take again", key, value.dump(), wanted));
}

void read_number(const std::string& key, const nlohmann::json& value, double& member, double low,
                 double high) {
    if (!value.is_number()) bad_value(key, value, "a number");
    member = value.get<double>();
    if (!(member >= low && member <= high))
        bad_value(key, value, fmt::format("between {} and {}", low, high));
}

void read_number(const std::string& key, const nlohmann::json& value, Eigen::Vector3d& member, double low,
                 double high) {
    if (!value.is_array() || value.size() != 3) bad_value(key, value, "a colour (three numbers)");
    for (int k = 0; k < 3; ++k) read_number(key, value[static_cast<std::size_t>(k)], member[k], low, high);
}

constexpr const char* kRotLookPrefix = "rot_look.";

}  // namespace

LinearColour linear_from_typed(const Eigen::Vector3d& srgb) {
    LinearColour linear;
    for (int k = 0; k < 3; ++k) {
        const double c = srgb[k];
        linear[k] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return linear;
}

MoldLook mold_look(const std::string& species) {
    std::string lower = species;
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (lower.find("pectobacterium") != std::string::npos) lower = "erwinia";
    for (const MoldLook& mold : molds())
        if (lower.find(mold.key) != std::string::npos) return mold;
    return plain_mold();
}

RotLook rot_look_from_json(const nlohmann::json& json, RotLook look) {
    if (!json.is_object()) return look;
    for_each_member(look, [&](const char* name, auto& member, double low, double high) {
        const std::string key = std::string(kRotLookPrefix) + name;
        if (const auto found = json.find(key); found != json.end())
            read_number(key, *found, member, low, high);
    });
    const std::string key = std::string(kRotLookPrefix) + "species";
    if (const auto found = json.find(key); found != json.end()) {
        if (!found->is_string()) bad_value(key, *found, "a text");
        look.species = found->template get<std::string>();
    }
    return look;
}

}  // namespace windfall::decay
