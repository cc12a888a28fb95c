#pragma once
// Descriptions of single processes, for the list in process.cpp.
#include <vector>

#include "core/parameter.h"
#include "recipe/process.h"

namespace windfall::recipe {

Process drying_process();
Process fracture_process();
Process decay_process();

/// The entries of a process's own table as entries of the recipe that holds its parameters in `member`.
template <class Parameters>
std::vector<Parameter<Recipe>> of_recipe(const ParameterTable<Parameters>& table,
                                         Parameters Recipe::*member) {
    std::vector<Parameter<Recipe>> result;
    for (const auto& entry : table.entries())
        result.push_back({entry.info, [&entry, member](const Recipe& r) { return entry.get(r.*member); },
                          [&entry, member](Recipe& r, const ParameterValue& v) { entry.set(r.*member, v); }});
    return result;
}

/// The look of fruit, with the checks that one entry alone cannot make.
std::vector<Parameter<Recipe>> look_of_recipe();
/// The look of rot and mold.
std::vector<Parameter<Recipe>> rot_look_of_recipe();

}  // namespace windfall::recipe
