#pragma once
// TOML as a flat list of keys and values with their places, before anything is known of what the keys mean.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/parameter.h"

namespace windfall::recipe {

/// key = value, somewhere.
struct Assignment {
    std::string key;                      ///< with its tables: "fruit.r4"
    std::string place;                    ///< "plum.toml:3:1", or "--set fruit.r4=1"
    std::optional<ParameterValue> value;  ///< empty when no parameter can hold it: a date, a list of tables
    std::optional<std::vector<std::string>> texts;  ///< a list of texts, in place of `value`
};

/// What is wrong and where, for people.
struct Mistake {
    std::string place;
    std::string text;
};

/// The assignments of a recipe file in the order in which they stand in it. A table that is not in `tables`
/// is one mistake, and what it holds is left out. Throws InputError for a file that cannot be read or is not
/// TOML.
std::vector<Assignment> read_file(const std::filesystem::path& path, const std::vector<std::string>& tables,
                                  std::vector<Mistake>& mistakes);

/// "key=value" as on the command line: the value is TOML, or a bare word or path, which is taken as
/// text. Throws InputError.
Assignment parse_setting(const std::string& setting);

}  // namespace windfall::recipe
