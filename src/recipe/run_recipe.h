#pragma once
// From a recipe to a take.
#include <filesystem>
#include <functional>

#include "core/run_context.h"
#include "recipe/recipe.h"
#include "take/take_writer.h"

namespace windfall::recipe {

/// What the take of this recipe says of itself.
take::TakeInfo take_info(const Recipe& recipe);

/// Whether `folder` holds the complete take of this recipe, so that there is nothing left to run; another
/// look or title needs no run. Throws InputError where there is no take.
bool is_complete(const Recipe& recipe, const std::filesystem::path& folder);

/// Runs the recipe's process into `writer`, from the writer's checkpoint where it has one, and leaves the
/// take's status as the run ended. `on_frame` (may be empty) is called for each frame once it is on disk.
/// Throws what the process throws: InputError, RunError, Cancelled.
void run(const Recipe& recipe, take::TakeWriter& writer, const RunContext& context,
         const std::function<void(const take::Frame&)>& on_frame = {});

}  // namespace windfall::recipe
