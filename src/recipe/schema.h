#pragma once
// The parameter tables as JSON, from which forms, reference pages and other programs are made.
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "core/parameter.h"

namespace windfall::recipe {

/// Every parameter of a recipe of this process, those of the look last.
std::vector<ParameterInfo> parameter_infos(const std::string& process = "drying");

/// {"version", "recipe_keys": [{"key", "type", "doc"}], "processes": {"drying": {"doc", "parameters":
/// [...]}}}. A parameter: {"key", "group", "type", "unit", "range", "minimum", "maximum", "minimum_excluded",
/// "maximum_excluded", "default", "choices", "doc", "needs_run"}; an absent end of a range is null.
nlohmann::json schema();

/// A value as JSON of its type.
nlohmann::json value_json(const ParameterValue& value);

/// Every parameter of `parameters`, key to value; the form of TakeInfo::parameters and TakeInfo::look.
template <class Parameters>
nlohmann::json values_json(const ParameterTable<Parameters>& table, const Parameters& parameters) {
    nlohmann::json values = nlohmann::json::object();
    for (const auto& entry : table.entries()) values[entry.info.key] = value_json(entry.get(parameters));
    return values;
}

}  // namespace windfall::recipe
