#include "drying/fibres.h"

#include "drying/drying_field.h"

namespace windfall::drying {

namespace {

bool has_fibres(FibreLayer where, bool skin) {
    return where == FibreLayer::Both || (where == FibreLayer::Skin) == skin;
}

}  // namespace

Fibres make_fibres(const geometry::LayeredMesh& mesh, const FibreParameters& parameters,
                   const LayerModuli& moduli) {
    Fibres result;
    if (!parameters.on()) return result;
    const int column = static_cast<int>(parameters.direction) - static_cast<int>(FibreDirection::Radial);
    for (const Eigen::Matrix3d& directions : fruit_directions(mesh))
        result.directions.emplace_back(directions.col(column));
    for (int k = 0; k < mesh.layers; ++k)
        result.moduli.push_back(has_fibres(parameters.layer, k >= mesh.flesh_layers)
                                    ? parameters.stiffness * moduli.shear[static_cast<std::size_t>(k)]
                                    : 0);
    result.shrinkage = parameters.shrinkage;
    return result;
}

}  // namespace windfall::drying
