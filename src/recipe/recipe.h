#pragma once
// A recipe: a TOML file that says what the specimen is, what happens to it and which frames to take. Presets
// are recipes that ship with the program. docs/recipes.md tells how to write one.
#include <string>
#include <vector>

#include "decay/parameters.h"
#include "decay/rot_colours.h"
#include "drying/parameters.h"
#include "fracture/parameters.h"
#include "picture/look.h"

namespace windfall::recipe {

/// A recipe with everything resolved: inherited preset, file, settings and, where none of them speaks,
/// defaults. Of the processes' parameters those of `process` hold; the others are left at their defaults.
struct Recipe {
    std::string process = "drying";  ///< one of process.h
    std::string name;         ///< of the preset, or the file's name without ".toml"; goes into file names
    std::string title;        ///< for people: "Jujube, prolate"; the name where the recipe gives none
    std::string description;  ///< a sentence or two; may be empty
    std::vector<std::string> sources;  ///< where the numbers come from
    drying::DryingParameters drying;
    fracture::FractureParameters fracture;
    decay::DecayParameters decay;
    picture::Look look;  ///< of fruit; wood has its colours among its parameters
    decay::RotLook rot_look = [] {
        decay::RotLook rotten;
        rotten.species.clear();  // that of the mold that grows
        return rotten;
    }();
};

/// Reads a shipped preset by its name or a recipe by the path of its file, then applies `settings`, each
/// "key=value" with a TOML value (a bare word or path is taken as text). A text with a '/' or ending in
/// ".toml" is a path, all else a preset's name. Throws InputError that lists every mistake found, one a line,
/// with file:line:column.
Recipe load(const std::string& preset_or_path, const std::vector<std::string>& settings = {});

/// The recipe with every key of its process written out. Loading it gives the same values to the last bit.
std::string to_toml(const Recipe& recipe);

}  // namespace windfall::recipe
