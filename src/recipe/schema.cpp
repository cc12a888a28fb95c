#include "recipe/schema.h"

#include <cmath>

#include "core/version.h"
#include "recipe/process.h"
#include "recipe/recipe_keys.h"

namespace windfall::recipe {
namespace {

nlohmann::json bound_json(double bound) {
    return std::isfinite(bound) ? nlohmann::json(bound) : nlohmann::json(nullptr);
}

nlohmann::json info_json(const ParameterInfo& info) {
    return {{"key", info.key},
            {"group", info.group()},
            {"type", info.type_name()},
            {"unit", info.unit},
            {"range", info.range_text()},
            {"minimum", bound_json(info.minimum)},
            {"maximum", bound_json(info.maximum)},
            {"minimum_excluded", info.minimum_excluded},
            {"maximum_excluded", info.maximum_excluded},
            {"default", value_json(info.default_value)},
            {"choices", info.choices},
            {"doc", info.doc},
            {"needs_run", info.needs_run}};
}

}  // namespace

nlohmann::json value_json(const ParameterValue& value) {
    return std::visit([](const auto& held) { return nlohmann::json(held); }, value);
}

nlohmann::json schema() {
    nlohmann::json keys = nlohmann::json::array();
    for (const auto& info : recipe_keys()) keys.push_back(info_json(info));
    nlohmann::json all = nlohmann::json::object();
    for (const Process& process : processes()) {
        nlohmann::json parameters = nlohmann::json::array();
        for (const auto& info : parameter_infos(process)) parameters.push_back(info_json(info));
        all[process.name] = {{"command", process.command}, {"doc", process.doc}, {"parameters", parameters}};
    }
    return {{"version", program_version()}, {"recipe_keys", keys}, {"processes", all}};
}

nlohmann::json values_json(const std::vector<Parameter<Recipe>>& parameters, const Recipe& recipe) {
    nlohmann::json values = nlohmann::json::object();
    for (const auto& parameter : parameters) values[parameter.info.key] = value_json(parameter.get(recipe));
    return values;
}

}  // namespace windfall::recipe
