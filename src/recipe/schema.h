#pragma once
// The parameter tables as JSON, from which forms, reference pages and other programs are made.
#include <nlohmann/json.hpp>

#include <vector>

#include "core/parameter.h"
#include "recipe/recipe.h"

namespace windfall::recipe {

/// {"version", "recipe_keys": [{"key", "type", "doc"}], "processes": {"drying": {"command", "doc",
/// "parameters": [...]}, ...}}. A parameter: {"key", "group", "type", "unit", "range", "minimum", "maximum",
/// "minimum_excluded", "maximum_excluded", "default", "choices", "doc", "needs_run"}; an absent end of a
/// range is null.
nlohmann::json schema();

/// A value as JSON of its type.
nlohmann::json value_json(const ParameterValue& value);

/// Every parameter, key to its value in `recipe`; the form of TakeInfo::parameters and TakeInfo::look.
nlohmann::json values_json(const std::vector<Parameter<Recipe>>& parameters, const Recipe& recipe);

}  // namespace windfall::recipe
