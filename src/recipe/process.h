#pragma once
// The processes that a recipe can name, each described in one place. All else in this folder, and the
// program, go by these descriptions.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/parameter.h"
#include "core/run_context.h"
#include "recipe/recipe.h"
#include "take/frame_sink.h"
#include "take/take_reader.h"

namespace windfall::recipe {

/// What a run will do, for people, and what speaks against it.
struct RunPlan {
    std::vector<std::pair<std::string, std::string>> lines;  ///< {"mesh", "48 x 80 x 48 brick, 8 layers"}
    std::vector<std::string> warnings;                       ///< each with the number to set
};

/// A column of the table that `windfall measure` prints, a line a frame.
struct MeasureColumn {
    std::string key, title;
    int digits = 0;
};

struct Process {
    std::string name;     ///< in recipes and takes: "drying"
    std::string command;  ///< of the program: "dry"
    std::string doc;      ///< what it does to which specimen: "dry a fruit until its skin wrinkles"
    std::vector<Parameter<Recipe>> parameters;  ///< its own, in the order of files and references
    std::vector<Parameter<Recipe>> look;        ///< what pictures depend on besides; wood: nothing
    std::vector<MeasureColumn> measure_columns;

    void (*check)(const Recipe&) = nullptr;  ///< between parameters; throws InputError naming the keys
    double (*unit_length_m)(const Recipe&) = nullptr;
    RunPlan (*plan)(const Recipe&) = nullptr;
    void (*run)(const Recipe&, take::FrameSink&, const RunContext&,
                std::span<const std::byte> checkpoint) = nullptr;
    nlohmann::json (*measure)(const take::TakeReader&) = nullptr;

    /// A parameter of its own or of the look; null when it has no such key.
    const Parameter<Recipe>* find(const std::string& key) const;
};

/// All of them; the first is that of a recipe that names none.
const std::vector<Process>& processes();

/// Throws InputError when there is no process of this name.
const Process& process_named(const std::string& name);

/// Every parameter of a recipe of this process, those of the look last.
std::vector<ParameterInfo> parameter_infos(const Process& process);

/// The seed of the recipe's process.
std::uint64_t seed_of(const Recipe& recipe);

}  // namespace windfall::recipe
