#include "recipe/schema.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/version.h"
#include "drying/parameters.h"
#include "picture/look.h"
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

std::vector<ParameterInfo> parameter_infos(const std::string& process) {
    if (process != "drying") throw InputError(fmt::format("there is no process \"{}\"", process));
    std::vector<ParameterInfo> infos = drying::drying_parameters().infos();
    for (auto& info : picture::look_parameters().infos()) infos.push_back(std::move(info));
    return infos;
}

nlohmann::json value_json(const ParameterValue& value) {
    return std::visit([](const auto& held) { return nlohmann::json(held); }, value);
}

nlohmann::json schema() {
    nlohmann::json keys = nlohmann::json::array();
    for (const auto& info : recipe_keys()) keys.push_back(info_json(info));
    nlohmann::json parameters = nlohmann::json::array();
    for (const auto& info : parameter_infos("drying")) parameters.push_back(info_json(info));
    return {{"version", program_version()},
            {"recipe_keys", keys},
            {"processes", {{"drying", {{"command", "dry"}, {"parameters", parameters}}}}}};
}

}  // namespace windfall::recipe
