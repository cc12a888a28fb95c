#include "drying/frame_maker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace windfall::drying {

using geometry::LayeredMesh;
using geometry::Vec3;

namespace {

/// What is summed over all elements, and what the outermost ones leave on the skin's vertices.
struct SolidSums {
    double flesh_fresh = 0, flesh_now = 0;
    double skin_fresh = 0, skin_now = 0;
    double smallest_total = 1e30;
    double smallest_elastic = 1e30, largest_elastic = -1e30;
    double dried_volume = 0;
    std::vector<double> volume_ratio, pressure;  ///< per vertex of the skin

    void add(const SolidSums& other) {
        flesh_fresh += other.flesh_fresh;
        flesh_now += other.flesh_now;
        skin_fresh += other.skin_fresh;
        skin_now += other.skin_now;
        smallest_total = std::min(smallest_total, other.smallest_total);
        smallest_elastic = std::min(smallest_elastic, other.smallest_elastic);
        largest_elastic = std::max(largest_elastic, other.largest_elastic);
        dried_volume += other.dried_volume;
    }
};

/// Means of what adjacent quads have.
std::vector<double> to_vertices(const geometry::BrickSurface& brick, const std::vector<double>& of_quads) {
    std::vector<double> sums(brick.vertex_count(), 0);
    std::vector<int> adjacent(brick.vertex_count(), 0);
    for (std::size_t q = 0; q < of_quads.size(); ++q)
        for (const std::int32_t vertex : brick.quads[q]) {
            sums[vertex] += of_quads[q];
            ++adjacent[vertex];
        }
    for (std::size_t v = 0; v < sums.size(); ++v) sums[v] /= adjacent[v];
    return sums;
}

SolidSums sum_elements(const DryingPath& path) {
    constexpr std::size_t kBlock = 256;  // quads
    const LayeredMesh& mesh = path.mesh();
    const DryingField drying = path.stress_free();
    const AlignedArray<double> volumes = path.elasticity().volumes(path.state().displacements.front());
    const std::vector<std::int32_t>& brick_quad = path.elasticity().multigrid().order().brick_quad;
    const auto layers = static_cast<std::size_t>(mesh.layers);
    const std::size_t quads = brick_quad.size();
    std::vector<double> volume_ratio(quads);
    std::vector<double> pressure(quads);
    std::vector<SolidSums> blocks((quads + kBlock - 1) / kBlock);
    const auto add = [&](SolidSums& sums, std::size_t solver_quad, int k) {
        const double* entries = volumes.data() + solver_quad * kVolumeEntries * layers + k;
        const double fresh = entries[0];
        const double now = entries[layers];
        const double smallest = entries[2 * layers];
        const double largest = entries[3 * layers];
        const auto q = static_cast<std::size_t>(brick_quad[solver_quad]);
        const double dried = drying(q, k).determinant();
        (k < mesh.flesh_layers ? sums.flesh_fresh : sums.skin_fresh) += fresh;
        (k < mesh.flesh_layers ? sums.flesh_now : sums.skin_now) += now;
        sums.dried_volume += fresh * dried;
        sums.smallest_total = std::min(sums.smallest_total, smallest);
        sums.smallest_elastic = std::min(sums.smallest_elastic, smallest / dried);
        sums.largest_elastic = std::max(sums.largest_elastic, largest / dried);
        if (k + 1 < mesh.layers) return;
        volume_ratio[q] = now / (fresh * dried);
        pressure[q] = -path.moduli().bulk[k] * (volume_ratio[q] - 1);
    };
    parallel_blocks(quads, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q)
            for (int k = 0; k < mesh.layers; ++k) add(blocks[begin / kBlock], q, k);
    });
    SolidSums sums;
    for (const SolidSums& block : blocks) sums.add(block);
    sums.volume_ratio = to_vertices(mesh.brick, volume_ratio);
    sums.pressure = to_vertices(mesh.brick, pressure);
    return sums;
}

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

take::TakeMesh skin_mesh(const LayeredMesh& mesh) {
    take::TakeMesh result;
    result.name = kSkinMesh;
    result.rest.positions = mesh.level_positions(mesh.layers);
    result.rest.faces = mesh.faces();
    result.rest.corner_uvs = geometry::brick_atlas(mesh.brick);
    return result;
}

take::Frame make_frame(const DryingPath& path, const DryingParameters& parameters, int index) {
    const LayeredMesh& mesh = path.mesh();
    const SolidSums sums = sum_elements(path);
    const std::vector<Vec3> rest = mesh.level_positions(mesh.layers);
    const std::vector<Vec3> skin = path.skin_positions();
    const auto faces = mesh.faces();
    const std::vector<double> fresh_areas = geometry::vertex_areas(rest, faces);
    const std::vector<double> areas = geometry::vertex_areas(skin, faces);
    std::vector<double> stretch(areas.size());
    for (std::size_t v = 0; v < areas.size(); ++v) stretch[v] = std::sqrt(areas[v] / fresh_areas[v]);

    take::Frame frame;
    frame.index = index;
    frame.time = path.parameter() / frame_parameters(parameters).back();
    take::FrameMesh surface;
    surface.name = kSkinMesh;
    for (const Vec3& position : skin) surface.positions.emplace_back(position.cast<float>());
    surface.attributes.push_back({"depth", 1, to_floats(path.skin_depth())});
    surface.attributes.push_back({"stretch", 1, to_floats(stretch)});
    surface.attributes.push_back({"J", 1, to_floats(sums.volume_ratio)});
    surface.attributes.push_back({"pressure", 1, to_floats(sums.pressure)});
    if (const std::vector<double> moisture = path.course().skin_moisture(path.state().course);
        !moisture.empty())
        surface.attributes.push_back({"moisture", 1, to_floats(to_vertices(mesh.brick, moisture))});
    if (const std::vector<double> dryness = path.course().skin_dryness(path.state().course); !dryness.empty())
        surface.attributes.push_back({"dryness", 1, to_floats(to_vertices(mesh.brick, dryness))});
    frame.meshes.push_back(std::move(surface));

    const StepRecord last = path.state().history.empty() ? StepRecord{} : path.state().history.back();
    frame.scalars = {
        {"shrinkage", path.shrinkage()},
        {"flesh_volume_ratio", sums.flesh_now / sums.flesh_fresh},
        {"skin_volume_ratio", sums.skin_now / sums.skin_fresh},
        {"total_volume_ratio",
         geometry::enclosed_volume(skin, faces) / geometry::enclosed_volume(rest, faces)},
        {"J_total_min", sums.smallest_total},
        {"J_elastic_min", sums.smallest_elastic},
        {"J_elastic_max", sums.largest_elastic},
        {"J_elastic_mean", (sums.flesh_now + sums.skin_now) / sums.dried_volume},
        {"J_drying_mean", sums.dried_volume / (sums.flesh_fresh + sums.skin_fresh)},
        {"elastic_energy", last.elastic_energy},
        {"viscous_work", last.viscous_work},
        {"viscous_over_elastic", last.elastic_energy > 0 ? last.viscous_work / last.elastic_energy : 0},
    };
    frame.scalars.merge(path.course().measures(path.state().course));
    return frame;
}

}  // namespace windfall::drying
