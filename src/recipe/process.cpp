#include "recipe/process.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/nearest_name.h"
#include "recipe/process_entry.h"

namespace windfall::recipe {

const Parameter<Recipe>* Process::find(const std::string& key) const {
    for (const auto* list : {&parameters, &look})
        for (const Parameter<Recipe>& parameter : *list)
            if (parameter.info.key == key) return &parameter;
    return nullptr;
}

const std::vector<Process>& processes() {
    static const std::vector<Process> kProcesses = {drying_process(), fracture_process(), decay_process()};
    return kProcesses;
}

const Process& process_named(const std::string& name) {
    std::vector<std::string> names;
    for (const Process& process : processes()) {
        if (process.name == name) return process;
        names.push_back(process.name);
    }
    throw InputError(
        fmt::format("there is no process \"{}\"; choose one of {}", name, fmt::join(names, ", ")));
}

std::vector<ParameterInfo> parameter_infos(const Process& process) {
    std::vector<ParameterInfo> infos;
    for (const auto* list : {&process.parameters, &process.look})
        for (const Parameter<Recipe>& parameter : *list) infos.push_back(parameter.info);
    return infos;
}

std::uint64_t seed_of(const Recipe& recipe) {
    const ParameterValue seed = process_named(recipe.process).find("seed")->get(recipe);
    return static_cast<std::uint64_t>(std::get<std::int64_t>(seed));
}

std::vector<Parameter<Recipe>> look_of_recipe() {
    std::vector<Parameter<Recipe>> result = of_recipe(picture::look_parameters(), &Recipe::look);
    for (Parameter<Recipe>& parameter : result)
        parameter.set = [key = parameter.info.key](Recipe& recipe, const ParameterValue& value) {
            picture::set_look(recipe.look, key, value);
        };
    return result;
}

}  // namespace windfall::recipe
