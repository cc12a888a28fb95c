#include "recipe/export_calculix.h"

#include <fmt/format.h>

#include "drying/calculix_deck.h"
#include "drying/imperfection.h"
#include "drying/specimen.h"
#include "recipe/fruit_file.h"
#include "recipe/recipe.h"
#include "take/take_folder.h"
#include "take/take_reader.h"
#include "take/whole_file.h"

namespace windfall::recipe {

namespace fs = std::filesystem;

fs::path export_calculix(const fs::path& take_folder, const fs::path& output, bool overwrite,
                         const RunContext& context) {
    const take::TakeReader take(take_folder);  // complains where there is no take
    const Recipe recipe = load(take::recipe_path(take.folder()).string());
    if (recipe.process != "drying")
        throw InputError(fmt::format("{}: a take of \"{}\"; decks for CalculiX are made of drying fruit",
                                     take.folder().string(), recipe.process));
    const fs::path path = output.extension() == ".inp" ? output : output / (recipe.name + ".inp");
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw InputError(fmt::format("{} is a folder; choose another name with -o", path.string()));
    if (!overwrite && fs::exists(path, ignored))
        throw InputError(fmt::format(
            "{} is there already; add --force to replace it, or choose another name with -o", path.string()));

    const auto fruit = read_fruit(recipe.drying);
    geometry::LayeredMesh mesh =
        fruit ? drying::make_mesh(recipe.drying, *fruit)
              : drying::make_mesh(recipe.drying, *drying::make_shape(recipe.drying.fruit));
    drying::add_imperfection(mesh, recipe.drying, context);
    const std::string deck = drying::calculix_deck(mesh, recipe.drying);
    if (const fs::path folder = path.parent_path(); !folder.empty()) take::make_writable_folder(folder);
    take::write_whole_file(path, deck);
    return path;
}

}  // namespace windfall::recipe
