#pragma once
// What a take says of itself, in take.json.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace windfall::take {

struct TakeInfo {
    std::string process;          ///< "drying"
    std::string name;             ///< the preset or recipe it came from: "jujube"
    std::string title;            ///< for people: "Jujube, prolate"
    std::string program_version;  ///< of the program that wrote it
    std::uint64_t seed = 0;
    double unit_length_m =
        1;  ///< metres in one unit of length of meshes and frames (drying: r_1 of the fruit)
    nlohmann::json parameters;  ///< every parameter of the process, key to value, as it was used
    nlohmann::json look;      ///< every look parameter, key to value (a picture can be made anew with others)
    std::string recipe_text;  ///< the recipe as resolved, TOML; written to recipe.toml
};

}  // namespace windfall::take
