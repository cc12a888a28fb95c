#include "recipe/process_entry.h"

namespace windfall::recipe {
namespace {

Parameter<Recipe> colour(const std::string& key, Eigen::Vector3d decay::RotLook::*member,
                         const std::string& doc) {
    Parameter<Recipe> parameter;
    parameter.get = [member](const Recipe& r) {
        const Eigen::Vector3d& c = r.rot_look.*member;
        return ParameterValue(std::vector<double>{c.x(), c.y(), c.z()});
    };
    parameter.set = [member](Recipe& r, const ParameterValue& value) {
        const auto& c = std::get<std::vector<double>>(value);
        if (c.size() != 3) throw InputError("a colour takes three numbers: red, green, blue");
        r.rot_look.*member = {c[0], c[1], c[2]};
    };
    parameter.info.key = "rot_look." + key;
    parameter.info.unit = "sRGB";
    parameter.info.doc = doc;
    parameter.info.minimum = 0;
    parameter.info.maximum = 1;
    return parameter;
}

Parameter<Recipe> number(const std::string& key, const std::string& unit, double decay::RotLook::*member,
                         const std::string& doc, double smallest, double largest) {
    Parameter<Recipe> parameter;
    parameter.get = [member](const Recipe& r) { return ParameterValue(r.rot_look.*member); };
    parameter.set = [member](Recipe& r, const ParameterValue& value) {
        const auto* integer = std::get_if<std::int64_t>(&value);
        r.rot_look.*member = integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
    };
    parameter.info.key = "rot_look." + key;
    parameter.info.unit = unit;
    parameter.info.doc = doc;
    parameter.info.minimum = smallest;
    parameter.info.maximum = largest;
    return parameter;
}

Parameter<Recipe> species() {
    Parameter<Recipe> parameter;
    parameter.get = [](const Recipe& r) {
        if (!r.rot_look.species.empty()) return ParameterValue(r.rot_look.species);
        const std::vector<std::string> fungi = decay::fungus_names(r.decay.growth);
        return ParameterValue(fungi.empty() ? std::string("none") : fungi.front());
    };
    parameter.set = [](Recipe& r, const ParameterValue& value) {
        r.rot_look.species = std::get<std::string>(value);
    };
    parameter.info.key = "rot_look.species";
    parameter.info.doc = "whose colours and hair the mold has; that of growth.fungi when left out";
    return parameter;
}

}  // namespace

std::vector<Parameter<Recipe>> rot_look_of_recipe() {
    using L = decay::RotLook;
    std::vector<Parameter<Recipe>> look{
        colour("fresh_colour", &L::fresh_colour, "of the sound skin"),
        colour("blush_colour", &L::blush_colour, "of its sunny side"),
        number("blush", "1", &L::blush, "share of the skin that the blush takes", 0, 1),
        number("streaks", "1", &L::streaks, "0: the blush lies in patches; 1: in streaks from stem to calyx",
               0, 1),
        number("mottle", "1", &L::mottle, "strength of lighter and darker patches", 0, 1),
        number("mottle_scale_m", "m", &L::mottle_scale_m, "size of those patches", 0.0005, 0.1),
        number("roughness", "1", &L::roughness, "of the sound skin: 0 a mirror, 1 chalk", 0.02, 1),
        colour("soaked_colour", &L::soaked_colour,
               "of skin under which the flesh gives way: the margin of rot"),
        colour("rot_colour", &L::rot_colour, "of rotten skin"),
        colour("old_rot_colour", &L::old_rot_colour, "of skin that has been rotten for long"),
        number("full_rot", "1", &L::full_rot, "value of the map soft_rot where rot is as dense as it gets",
               0.01, 1),
        species(),
    };
    for (Parameter<Recipe>& parameter : look) {
        parameter.info.default_value = parameter.get(Recipe{});
        parameter.info.needs_run = false;
    }
    return look;
}

}  // namespace windfall::recipe
