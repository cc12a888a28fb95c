#pragma once
// The keys at the head of a recipe that belong to no process.
#include <string>
#include <vector>

#include "core/parameter.h"

namespace windfall::recipe {

/// The processes that a recipe can name, the default first.
const std::vector<std::string>& process_names();

/// process, name, title, description, source and preset, described as parameters are. `source` may also be a
/// list of texts, which no parameter can.
const std::vector<ParameterInfo>& recipe_keys();

/// Null when there is no such key.
const ParameterInfo* find_recipe_key(const std::string& key);

/// Whether the bytes are well-formed UTF-8, as JSON and TOML want their texts.
bool is_utf8(const std::string& text);

}  // namespace windfall::recipe
