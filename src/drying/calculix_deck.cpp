#include "drying/calculix_deck.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "drying/elasticity.h"

namespace windfall::drying {

using geometry::LayeredMesh;
using geometry::Vec3;

namespace {

using Text = fmt::memory_buffer;

template <class... Arguments>
void print_to(Text& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

void check_isotropic(const ShrinkageParameters& drying) {
    if (drying.radial == drying.meridional && drying.meridional == drying.latitudinal) return;
    throw InputError(
        fmt::format("a CalculiX deck holds isotropic drying only, and drying.radial, drying.meridional and "
                    "drying.latitudinal are {}, {} and {}: make them equal, or export the frames instead",
                    drying.radial, drying.meridional, drying.latitudinal));
}

void put_header(Text& text, const LayeredMesh& mesh) {
    print_to(
        text,
        "** Drying of a core/shell fruit: an input deck for CalculiX (ccx), written by Windfall.\n"
        "** Lengths in r_1, stresses in C0 of the flesh (shear modulus 2). Temperature 0 is fresh, 1 is "
        "dry.\n"
        "** Node    1 + vertex * {} + level: level 0 lies on the stone, level {} on the skin; the vertices\n"
        "**         of the skin are numbered from 0 as in the take.\n"
        "** Element 1 + quad * {} + layer: layers 0 to {} are flesh, {} to {} skin.\n",
        mesh.layers + 1, mesh.layers, mesh.layers, mesh.flesh_layers - 1, mesh.flesh_layers, mesh.layers - 1);
}

void put_nodes(Text& text, const LayeredMesh& mesh) {
    print_to(text, "*NODE, NSET=ALL\n");
    for (std::size_t v = 0; v < mesh.columns(); ++v)
        for (int level = 0; level <= mesh.layers; ++level) {
            const Vec3& x = mesh.node(v, level);
            // 20 characters are what CalculiX reads of a number.
            print_to(text, "{},{:.12e},{:.12e},{:.12e}\n", calculix_node(mesh, v, level), x.x(), x.y(),
                     x.z());
        }
}

/// Elements of the layers [first, last).
void put_elements(Text& text, const LayeredMesh& mesh, const char* set, int first, int last) {
    print_to(text, "*ELEMENT, TYPE=C3D8, ELSET={}\n", set);
    for (std::size_t q = 0; q < mesh.brick.quads.size(); ++q)
        for (int layer = first; layer < last; ++layer) {
            print_to(text, "{}",
                     q * static_cast<std::size_t>(mesh.layers) + static_cast<std::size_t>(layer) + 1);
            // C3D8 wants four nodes counter-clockwise as seen from the other four, and those above them: seen
            // from outside, the lower face of a layer first.
            for (int level = layer; level <= layer + 1; ++level)
                for (const std::int32_t vertex : mesh.brick.quads[q])
                    print_to(text, ",{}", calculix_node(mesh, static_cast<std::size_t>(vertex), level));
            print_to(text, "\n");
        }
}

void put_node_set(Text& text, const LayeredMesh& mesh, const char* set, int level) {
    print_to(text, "*NSET, NSET={}\n", set);
    for (std::size_t v = 0; v < mesh.columns(); ++v) print_to(text, "{}\n", calculix_node(mesh, v, level));
}

void put_material(Text& text, const char* name, double shear, double bulk, double expansion) {
    // CalculiX's law is C10 (I1bar - 3) + (J - 1)^2 / D1, Windfall's mu/2 (I1 - 3) - mu ln J + kappa/2 (J -
    // 1)^2; the latter's bulk modulus about J = 1 is kappa + 2/3 mu. At a high bulk ratio they are the same.
    print_to(text,
             "*MATERIAL, NAME={0}\n"
             "*HYPERELASTIC, NEO HOOKE\n"
             "{1:.12e},{2:.12e}\n"
             "*EXPANSION, ZERO=0.\n"
             "{3:.12e}\n"
             "*SOLID SECTION, ELSET={0}, MATERIAL={0}\n",
             name, shear / 2, 2 / (bulk + 2 * shear / 3), expansion);
}

}  // namespace

int calculix_node(const LayeredMesh& mesh, std::size_t vertex, int level) {
    return 1 + static_cast<int>(vertex) * (mesh.layers + 1) + level;
}

std::string calculix_deck(const LayeredMesh& mesh, const DryingParameters& parameters) {
    check_isotropic(parameters.drying);
    if (parameters.segments.count > 0)
        throw InputError("a CalculiX deck holds fruit without walls only: set segments.count = 0");
    if (parameters.fibres.on())
        throw InputError(
            "a CalculiX deck holds fruit without fibres only: set fibres.direction = \"none\", or export the "
            "frames instead");
    const double shrinkage = parameters.drying.shrinkage * parameters.drying.radial;
    const LayerModuli moduli = layer_moduli(mesh.flesh_layers, mesh.layers, parameters.material.gamma,
                                            parameters.material.bulk_ratio);
    Text text;
    put_header(text, mesh);
    put_nodes(text, mesh);
    put_elements(text, mesh, "FLESH", 0, mesh.flesh_layers);
    put_elements(text, mesh, "SKIN", mesh.flesh_layers, mesh.layers);
    put_node_set(text, mesh, "STONE", 0);
    put_node_set(text, mesh, "SKIN_SURFACE", mesh.layers);
    put_material(text, "FLESH", moduli.shear.front(), moduli.bulk.front(), -shrinkage);
    put_material(text, "SKIN", moduli.shear.back(), moduli.bulk.back(),
                 -shrinkage * parameters.drying.skin_fraction);
    // Increments of the step's time, which is 1: as long as Windfall's own.
    const double increment = std::min(0.25, parameters.solver.max_step / parameters.drying.shrinkage);
    print_to(text,
             "*BOUNDARY\n"
             "STONE,1,3\n"
             "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
             "ALL,0.\n"
             "*STEP, NLGEOM, INC=100000\n"
             "*STATIC\n"
             "{0:.6e},1.,1.e-6,{0:.6e}\n"
             "*CONTROLS, PARAMETERS=FIELD\n"
             "1.e-6,1.e-6\n"
             "*TEMPERATURE\n"
             "ALL,1.\n"
             "*NODE PRINT, NSET=SKIN_SURFACE, FREQUENCY=100000\n"
             "U\n"
             "*END STEP\n",
             increment);
    return fmt::to_string(text);
}

}  // namespace windfall::drying
