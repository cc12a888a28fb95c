#include "picture/look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/nearest_name.h"

namespace windfall::picture {
namespace {

/// The table under construction: none of its parameters needs the simulation again.
struct LookTable {
    ParameterTable<Look> table;

    template <class Member>
    void add(const std::string& key, Member member, const std::string& doc, const ParameterRange& range) {
        table.add(key, "1", member, doc, range).info.needs_run = false;
    }
};

ParameterTable<Look> make_table() {
    const ParameterRange unit{.minimum = 0, .maximum = 1};
    LookTable table;
    table.add(
        "look.fresh_colour", [](auto& l) -> auto& { return l.fresh_colour; },
        "Colour of the fresh skin: sRGB red, green, blue", unit);
    table.add(
        "look.dry_colour", [](auto& l) -> auto& { return l.dry_colour; },
        "Colour of the dried skin: sRGB red, green, blue", unit);
    table.add("look.roughness", [](auto& l) -> auto& { return l.roughness; },
              "Roughness of the skin: small is polished, 1 is dull", {.minimum = 0.05, .maximum = 1});
    table.add(
        "look.gloss", [](auto& l) -> auto& { return l.gloss; },
        "Strength of the highlights of the skin's clear coat; 0: none", unit);
    table.add("look.softness", [](auto& l) -> auto& { return l.softness; },
              "How far light spreads under the skin, in radii of the fresh fruit; 0: opaque as paint",
              {.minimum = 0, .maximum = 0.3});
    table.add(
        "look.softness_colour", [](auto& l) -> auto& { return l.softness_colour; },
        "Share of look.softness for red, green and blue light", unit);
    table.add(
        "look.mottle", [](auto& l) -> auto& { return l.mottle; },
        "Strength of the lighter and darker patches, which stick to the skin", unit);
    table.add("look.mottle_scale", [](auto& l) -> auto& { return l.mottle_scale; },
              "Size of the patches, in radii of the fresh fruit", {.minimum = 0.01, .maximum = 10});
    table.add(
        "look.grain", [](auto& l) -> auto& { return l.grain; },
        "Fine unevenness of the skin, which breaks up its highlights; 0: polished", unit);
    table.add("look.grain_scale", [](auto& l) -> auto& { return l.grain_scale; },
              "Size of the fine unevenness, in radii of the fresh fruit", {.minimum = 0.01, .maximum = 1});
    table.add("look.pores", [](auto& l) -> auto& { return l.pores; },
              "Depth of the pores of a citrus fruit; 1: those of an orange", {.minimum = 0, .maximum = 4});
    table.add("look.pore_size", [](auto& l) -> auto& { return l.pore_size; },
              "Size of the pores, in radii of the fresh fruit", {.minimum = 0.003, .maximum = 1});
    table.add(
        "look.bloom", [](auto& l) -> auto& { return l.bloom; },
        "Strength of the waxy film on the ridges, as on plums and raisins", unit);
    table.add(
        "look.bloom_colour", [](auto& l) -> auto& { return l.bloom_colour; },
        "Colour of the waxy film: sRGB red, green, blue", unit);
    table.add(
        "look.valley", [](auto& l) -> auto& { return l.valley; },
        "How far the valleys take on look.valley_colour", unit);
    table.add(
        "look.valley_colour", [](auto& l) -> auto& { return l.valley_colour; },
        "Colour of the bottom of the valleys: sRGB red, green, blue", unit);
    table.add("look.valley_depth", [](auto& l) -> auto& { return l.valley_depth; },
              "Depth at which a valley has its full colour, in radii of the fresh fruit",
              {.maximum = 1, .above = 0});
    table.table
        .add_choice(
            "look.pose", [](auto& l) -> auto& { return l.pose; }, {"standing", "lying"},
            "Whether the fruit stands on its end or lies on its side")
        .info.needs_run = false;
    return table.table;
}

ParameterValue value_from_json(const std::string& key, const nlohmann::json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_array() && std::all_of(json.begin(), json.end(), [](const auto& e) { return e.is_number(); }))
        return json.get<std::vector<double>>();
    throw InputError(fmt::format("{}: {} is no value of a parameter", key, json.dump()));
}

}  // namespace

const ParameterTable<Look>& look_parameters() {
    static const ParameterTable<Look> table = make_table();
    return table;
}

void set_look(Look& look, const std::string& key, const ParameterValue& value) {
    const auto* parameter = look_parameters().find(key);
    if (parameter == nullptr) {
        std::vector<std::string> keys;
        for (const auto& info : look_parameters().infos()) keys.push_back(info.key);
        const auto nearest = nearest_names(key, keys);
        throw InputError(fmt::format("{}: there is no such parameter of the look; {}", key,
                                     nearest.empty() ? fmt::format("choose one of {}", fmt::join(keys, ", "))
                                                     : fmt::format("did you mean {}?", nearest.front())));
    }
    if (const std::string problem = parameter->info.problem_with(value); !problem.empty())
        throw InputError(fmt::format("{} {}", key, problem));
    if (const auto* list = std::get_if<std::vector<double>>(&value); list != nullptr && list->size() != 3)
        throw InputError(
            fmt::format("{} must have three numbers (red, green, blue), not {}", key, list->size()));
    parameter->set(look, value);
}

Look look_from_json(const nlohmann::json& json) {
    Look look;
    if (json.is_null()) return look;
    if (!json.is_object()) throw InputError("the look of the take must be an object of keys and values");
    for (const auto& [key, value] : json.items())
        if (look_parameters().find(key) != nullptr) set_look(look, key, value_from_json(key, value));
    return look;
}

nlohmann::json look_to_json(const Look& look) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& entry : look_parameters().entries())
        std::visit([&](const auto& value) { json[entry.info.key] = value; }, entry.get(look));
    return json;
}

}  // namespace windfall::picture
