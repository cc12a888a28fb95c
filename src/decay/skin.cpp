#include "decay/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"

namespace windfall::decay {

namespace {

/// Strain at which the skin buckles.
constexpr double kBucklingStrain = 0.015;
constexpr double kEdgesAWave = 6;
constexpr double kLongestWave_m = 0.020;

constexpr int kSweeps = 4;
constexpr float kOverRelaxation = 1.2F;
/// Pull to where the vertex was at the start of the frame, over that to the flesh.
constexpr float kProximal = 0.3F;
/// Longest step of a sweep, in edges: Newton's model of a folded spring holds no further.
constexpr float kLongestStep = 0.25F;
/// Skin that is longer than the flesh below by more than this has given way: deeper folds would cross.
constexpr float kMostExcess = 0.20F;
/// A face that leans further than this (cosine) from the flesh below is about to fold over: there the skin
/// gives way, by so much a frame.
constexpr float kFoldCosine = 0.35F;
constexpr float kGivingWay = 0.04F;
/// Nearer to an obstacle than 0.3 of this no excess is left, since there is no room to buckle.
constexpr float kFlatteningGap_m = 0.005F;
/// A vertex moves against the flesh by at most so many times the flesh's own mean motion in the frame, or
/// what it was allowed a frame ago less a twentieth: without it single vertices in folds snap by 0.1 mm in
/// one frame, and tremble when nothing changes any more.
constexpr float kMostLead = 2;
constexpr float kCalming = 0.95F;
/// At first, in edges.
constexpr float kFirstLead = 0.002F;

/// Share of the difference of volume that a frame takes out.
constexpr float kInsetGain = 0.2F;

constexpr std::size_t kSkinBlock = 256;

/// Area vector of a quadrilateral.
Eigen::Vector4f quad_area(const std::vector<Eigen::Vector4f>& x, const std::array<std::int32_t, 4>& q) {
    const Eigen::Vector3f a = (x[q[2]] - x[q[0]]).head<3>();
    const Eigen::Vector3f b = (x[q[3]] - x[q[1]]).head<3>();
    const Eigen::Vector3f area = a.cross(b) / 2;
    return {area.x(), area.y(), area.z(), 0};
}

}  // namespace

SkinMaterial skin_material(double skin_modulus_pa, double thickness_m, double flesh_modulus_pa,
                           double mean_edge_m, double wave_length_m) {
    const double free_wave =
        2 * std::numbers::pi * thickness_m * std::cbrt(skin_modulus_pa / (3 * flesh_modulus_pa));
    const double shortest = kEdgesAWave * mean_edge_m;
    SkinMaterial m;
    m.thickness_m = thickness_m;
    m.wave_length_m =
        wave_length_m > 0 ? wave_length_m : std::max(shortest, std::min(free_wave, kLongestWave_m));
    m.membrane_n_m = skin_modulus_pa * thickness_m;
    const double root_of_product = kBucklingStrain * m.membrane_n_m / 2;                 // sqrt(K B)
    const double root_of_ratio = std::pow(m.wave_length_m / (2 * std::numbers::pi), 2);  // sqrt(B / K)
    m.bending_nm = root_of_product * root_of_ratio;
    m.tether_pa_m = root_of_product / root_of_ratio;
    return m;
}

Skin::Skin(const geometry::BrickSurface& brick, const std::vector<geometry::Vec3>& positions)
    : m_mesh(make_skin_mesh(brick, positions)), m_positions(positions.size()) {
    std::transform(positions.begin(), positions.end(), m_positions.begin(),
                   [](const geometry::Vec3& x) -> Eigen::Vector3f { return x.cast<float>(); });
    lay(m_positions, std::vector<float>(positions.size(), 0.0F));
}

void Skin::set_material(const SkinMaterial& material) {
    m_material = material;
    const std::size_t n = m_mesh.size();
    m_bending.resize(n);
    m_tether.resize(n);
    m_hessian.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        m_bending[i] = static_cast<float>(material.bending_nm) * m_mesh.bending[i];
        m_tether[i] = static_cast<float>(material.tether_pa_m) * m_mesh.area_m2[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
        m_hessian[i] = m_tether[i] * (1 + kProximal) + m_bending[i];
        for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
            const float w = m_mesh.weight_back[p];
            m_hessian[i] += m_bending[m_mesh.neighbours[p].vertex] * w * w;
        }
    }
}

void Skin::lay(const Positions& target, const std::vector<float>& stretch) {
    const std::size_t n = m_mesh.size();
    m_x.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto& y = target[m_mesh.vertex_of[i]];
        m_x[i] = Vec4(y.x(), y.y(), y.z(), 0);
    }
    m_target = m_x;
    m_rest_lengths.resize(m_mesh.neighbours.size());
    for (std::size_t i = 0; i < n; ++i)
        for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
            const auto j = m_mesh.neighbours[p].vertex;
            const float mean = (stretch[m_mesh.vertex_of[i]] + stretch[m_mesh.vertex_of[j]]) / 2;
            m_rest_lengths[p] = (m_x[i] - m_x[j]).norm() * (1 + mean);
        }
    m_lengths = m_rest_lengths;
    m_slack.assign(n, 1.0F);
    m_inset_m = 0;
    m_longest_move = kFirstLead * static_cast<float>(m_mesh.mean_edge_m);
    publish();
}

void Skin::publish() {
    m_positions.resize(m_mesh.size());
    for (std::size_t i = 0; i < m_mesh.size(); ++i) m_positions[m_mesh.vertex_of[i]] = m_x[i].head<3>();
}

void Skin::loosen_folds() {
    for (const auto& q : m_mesh.quads) {
        const Vec4 skin = quad_area(m_x, q);
        const Vec4 flesh = quad_area(m_target, q);
        const float limit = kFoldCosine * std::sqrt(skin.squaredNorm() * flesh.squaredNorm());
        if (skin.dot(flesh) < limit)
            for (const auto i : q) m_slack[i] = std::max(0.0F, m_slack[i] - kGivingWay);
    }
}

void Skin::place_target(const Positions& target) {
    const std::size_t n = m_mesh.size();
    m_flesh.resize(n);
    m_room.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3f& y = target[m_mesh.vertex_of[i]];
        m_flesh[i] = Vec4(y.x(), y.y(), y.z(), 0);
        float gap = m_ground[i].gap_m(y);
        // A neighbour's plane stands half way to it.
        if (!m_neighbour.empty()) gap = std::min(gap, 2 * m_neighbour[i].gap_m(y));
        m_room[i] = std::clamp(gap / kFlatteningGap_m - 0.3F, 0.0F, 1.0F);
    }
    m_flesh_areas.assign(n, Vec4::Zero());
    for (const auto& q : m_mesh.quads) {
        const Vec4 area = quad_area(m_flesh, q) / 4;
        for (const auto i : q) m_flesh_areas[i] += area;
    }
    double motion = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec4 y = m_flesh[i] - m_inset_m * m_room[i] * m_flesh_areas[i].normalized();
        const Vec4 moved = y - m_target[i];
        motion += moved.norm();
        m_x[i] += moved;
        m_target[i] = y;
    }
    m_longest_move =
        std::max(kMostLead * static_cast<float>(motion / static_cast<double>(n)), kCalming * m_longest_move);
}

void Skin::correct_inset() {
    double volume = 0;
    double area = 0;
    for (std::size_t i = 0; i < m_mesh.size(); ++i) {
        volume += m_flesh_areas[i].dot(m_x[i] - m_flesh[i]);
        area += m_room[i] * m_flesh_areas[i].norm();
    }
    if (area > 0) m_inset_m += kInsetGain * static_cast<float>(volume / area);
}

void Skin::cap_lengths() {
    parallel_blocks(m_mesh.size(), kSkinBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
                const auto j = static_cast<std::size_t>(m_mesh.neighbours[p].vertex);
                const float excess =
                    kMostExcess * std::min(m_slack[i], m_slack[j]) * (m_room[i] + m_room[j]) / 2;
                m_lengths[p] = std::min(m_rest_lengths[p], (m_target[i] - m_target[j]).norm() * (1 + excess));
            }
    });
}

void Skin::find_bending() {
    m_bend.resize(m_mesh.size());
    parallel_blocks(m_mesh.size(), kSkinBlock, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            Vec4 d = m_x[i] - m_target[i];
            for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
                const SkinNeighbour& near = m_mesh.neighbours[p];
                d -= near.weight * (m_x[near.vertex] - m_target[near.vertex]);
            }
            m_bend[i] = d;
        }
    });
}

void Skin::move(std::int32_t i) {
    const auto membrane = static_cast<float>(m_material.membrane_n_m);
    const Vec4 x = m_x[i];
    Vec4 force = -m_tether[i] * ((x - m_target[i]) + kProximal * (x - m_start[i])) - m_bending[i] * m_bend[i];
    // Hessian: `isotropic` I + `along`, the latter symmetric: xx, yy, zz and xy, yz, zx.
    float isotropic = m_hessian[i];
    float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
    for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
        const SkinNeighbour& near = m_mesh.neighbours[p];
        const Vec4 edge = x - m_x[near.vertex];
        const float inverse_length_sq = 1 / (edge.squaredNorm() + 1e-16F);
        const float stiffness = membrane * near.spring;
        const float pull = stiffness * (1 - m_lengths[p] * std::sqrt(inverse_length_sq));
        // A compressed spring would make the Hessian indefinite across its direction: left out there.
        const float across = std::max(pull, 0.0F);
        force += m_bending[near.vertex] * m_mesh.weight_back[p] * m_bend[near.vertex] - pull * edge;
        isotropic += across;
        const float along = (stiffness - across) * inverse_length_sq;
        xx += along * edge[0] * edge[0];
        yy += along * edge[1] * edge[1];
        zz += along * edge[2] * edge[2];
        xy += along * edge[0] * edge[1];
        yz += along * edge[1] * edge[2];
        zx += along * edge[2] * edge[0];
    }
    xx += isotropic;
    yy += isotropic;
    zz += isotropic;
    const float c0 = yy * zz - yz * yz;
    const float c1 = zx * yz - xy * zz;
    const float c2 = xy * yz - zx * yy;
    const float c3 = xy * zx - xx * yz;
    const float scale = kOverRelaxation / (xx * c0 + xy * c1 + zx * c2);
    Vec4 step(c0 * force[0] + c1 * force[1] + c2 * force[2],
              c1 * force[0] + (xx * zz - zx * zx) * force[1] + c3 * force[2],
              c2 * force[0] + c3 * force[1] + (xx * yy - xy * xy) * force[2], 0);
    step *= scale;
    const auto longest = kLongestStep * static_cast<float>(m_mesh.mean_edge_m);
    const float length_sq = step.squaredNorm();
    if (length_sq > longest * longest) step *= longest / std::sqrt(length_sq);
    Vec4 next = x + step;
    const Vec4 lead = next - m_start[i];
    const float lead_sq = lead.squaredNorm();
    if (lead_sq > m_longest_move * m_longest_move)
        next = m_start[i] + m_longest_move / std::sqrt(lead_sq) * lead;

    const auto keep_out = [&](const ContactPlane& plane) {
        const Eigen::Vector3f point = next.head<3>();
        if (plane.gap_m(point) >= 0) return;
        // Sliding is damped, which keeps the folds under the fruit from creeping out.
        next = x + 0.4F * (next - x);
        next.head<3>() -= plane.gap_m(next.head<3>()) * plane.normal;
    };
    if (!m_neighbour.empty()) keep_out(m_neighbour[i]);
    keep_out(m_ground[i]);
    const Vec4 moved = next - x;
    m_x[i] = next;
    m_bend[i] += moved;
    for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p)
        m_bend[m_mesh.neighbours[p].vertex] -= m_mesh.weight_back[p] * moved;
}

void Skin::sweep(bool forwards) {
    const std::size_t colours = m_mesh.colour_begin.size() - 1;
    for (std::size_t k = 0; k < colours; ++k) {
        const std::size_t colour = forwards ? k : colours - 1 - k;
        const auto first = m_mesh.colour_begin[colour];
        const auto count = m_mesh.colour_begin[colour + 1] - first;
        parallel_blocks(count, kSkinBlock, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) move(first + static_cast<std::int32_t>(i));
        });
    }
}

void Skin::advance(const Positions& target, const std::vector<ContactPlane>& ground,
                   const std::vector<ContactPlane>& neighbour) {
    const std::size_t n = m_mesh.size();
    m_ground.resize(n);
    m_neighbour.resize(neighbour.size());
    for (std::size_t i = 0; i < n; ++i) {
        const auto v = m_mesh.vertex_of[i];
        m_ground[i] = ground[v];
        if (!neighbour.empty()) m_neighbour[i] = neighbour[v];
    }
    place_target(target);
    m_start = m_x;
    loosen_folds();
    cap_lengths();
    find_bending();
    for (int s = 0; s < kSweeps; ++s) sweep(s % 2 == 0);
    correct_inset();
    publish();
}

double Skin::energy_j() const {
    double energy = 0;
    for (std::size_t i = 0; i < m_mesh.size(); ++i) {
        Vec4 bend = m_x[i] - m_target[i];
        energy += 0.5 * m_tether[i] * bend.squaredNorm();
        for (auto p = m_mesh.begin[i]; p < m_mesh.begin[i + 1]; ++p) {
            const SkinNeighbour& near = m_mesh.neighbours[p];
            const float stretch = (m_x[i] - m_x[near.vertex]).norm() - m_lengths[p];
            // Each spring is seen from both its ends.
            energy += 0.25 * m_material.membrane_n_m * near.spring * stretch * stretch;
            bend -= near.weight * (m_x[near.vertex] - m_target[near.vertex]);
        }
        energy += 0.5 * m_bending[i] * bend.squaredNorm();
    }
    return energy;
}

}  // namespace windfall::decay
