#pragma once
// The keys at the head of a recipe that belong to no process.
#include <string>
#include <vector>

#include "core/parameter.h"
#include "recipe/process.h"

namespace windfall::recipe {

/// process, name, title, description, source and preset, described as parameters are. `source` may also be a
/// list of texts, which no parameter can.
const std::vector<ParameterInfo>& recipe_keys();

/// Null when there is no such key.
const ParameterInfo* find_recipe_key(const std::string& key);

/// Names of the tables that a recipe file can have, of all processes.
const std::vector<std::string>& table_names();

/// Why a recipe of `process` cannot have `key`, and what to write instead.
std::string unknown_key_text(const std::string& key, const Process& process);

/// Whether the bytes are well-formed UTF-8, as JSON and TOML want their texts.
bool is_utf8(const std::string& text);

}  // namespace windfall::recipe
