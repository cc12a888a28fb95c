#include "decay/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/growth_state.h"

namespace windfall::decay {

using geometry::Vec3;

Growth::Growth(const geometry::CubeAtlas& atlas, std::span<const Vec3> texel_positions_m,
               const std::vector<Organism>& organisms, const GrowthSettings& settings, std::uint64_t seed,
               const GrowthFields& fields) {
    check(organisms, settings);
    const std::size_t count = atlas.texel_count();
    const auto fits = [count](std::size_t size, bool may_be_empty) {
        return size == count || (may_be_empty && size == 0);
    };
    if (!fits(texel_positions_m.size(), false) || !fits(fields.wetness.size(), true) ||
        !fits(fields.nutrient.size(), true))
        throw InputError(
            fmt::format("positions ({}), wetness ({}) and nutrient ({}) must have one value for each "
                        "of the {} texels",
                        texel_positions_m.size(), fields.wetness.size(), fields.nutrient.size(), count));
    m_state = std::make_unique<State>(atlas, texel_positions_m, organisms, settings, seed, fields);
}

Growth::~Growth() = default;
Growth::Growth(Growth&&) noexcept = default;
Growth& Growth::operator=(Growth&&) noexcept = default;

void Growth::advance(double hours, const GrowthConditions& conditions) {
    double left_h = hours;
    while (left_h > 0) {
        const double steps = std::ceil(left_h / m_state->longest_step_h(conditions) - 1e-9);
        const double step_h = steps > 1 ? left_h / steps : left_h;
        m_state->step(step_h, conditions);
        left_h = steps > 1 ? left_h - step_h : 0;
    }
}

double Growth::plant(std::size_t organism, std::size_t texel, double radius_m, double density) {
    auto& life = m_state->organisms.at(organism);
    const bool is_fungus = life.organism.species.kind == OrganismKind::Fungus;
    double planted = 0;
    for (const std::size_t i : disc(texel, radius_m)) {
        // A smooth spot: a jump would need far smaller steps for nothing.
        const double r = (m_state->positions[i] - m_state->positions[texel]).norm() / radius_m;
        const double wanted = density * (1 - r * r) * (1 - r * r) * (is_fungus ? m_state->gate[i] : 1.0F);
        const double gain = wanted - life.active[i];
        if (!(gain > 0) || wanted < kThinnestPlanted) continue;
        const float before = life.active[i];
        life.active[i] = static_cast<float>(wanted);
        planted += (static_cast<double>(life.active[i]) - before) / m_state->stencil.inverse_area[i];
        life.alive[m_state->tiles.tile_of(i)] = 1;
    }
    m_state->open_gate();
    return planted;
}

std::vector<std::size_t> Growth::disc(std::size_t texel, double radius_m) const {
    if (texel >= texel_count() || !(m_state->stencil.area_m2[texel] > 0))
        throw InputError(fmt::format("texel {} is not on the skin", texel));
    const Vec3& centre = m_state->positions[texel];
    const auto side = static_cast<std::ptrdiff_t>(m_state->stencil.side);
    std::vector<std::size_t> found{texel};
    std::vector<std::size_t> border{texel}, before;
    const auto visit = [&](std::size_t i, std::vector<std::size_t>& next) {
        if (m_state->stencil.area_m2[i] > 0 && (m_state->positions[i] - centre).norm() < radius_m)
            next.push_back(i);
    };
    while (!border.empty()) {
        std::vector<std::size_t> next;
        for (const std::size_t i : border) {
            for (const std::ptrdiff_t gap : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}, side, -side})
                visit(i + static_cast<std::size_t>(gap), next);
            const auto& seams = m_state->stencil.seam_texels;
            const auto seam = std::lower_bound(seams.begin(), seams.end(), i);
            if (seam == seams.end() || *seam != i) continue;
            const auto k = static_cast<std::size_t>(seam - seams.begin());
            for (std::uint32_t link = m_state->stencil.seam_begin[k];
                 link < m_state->stencil.seam_begin[k + 1]; ++link)
                visit(m_state->stencil.seam_neighbour[link], next);
        }
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        // Links lead both ways: what was found earlier than the border before cannot be met again.
        std::vector<std::size_t> not_before, fresh;
        std::set_difference(next.begin(), next.end(), before.begin(), before.end(),
                            std::back_inserter(not_before));
        std::set_difference(not_before.begin(), not_before.end(), border.begin(), border.end(),
                            std::back_inserter(fresh));
        found.insert(found.end(), fresh.begin(), fresh.end());
        before = std::exchange(border, std::move(fresh));
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::size_t Growth::nearest_texel(const Vec3& point_m) const {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < texel_count(); ++i) {
        if (!(m_state->stencil.area_m2[i] > 0)) continue;
        const double distance_sq = (m_state->positions[i] - point_m).squaredNorm();
        if (distance_sq < least) {
            least = distance_sq;
            nearest = i;
        }
    }
    return nearest;
}

std::size_t Growth::organism_count() const { return m_state->organisms.size(); }
const Organism& Growth::organism(std::size_t o) const { return m_state->organisms.at(o).organism; }
std::size_t Growth::texel_count() const { return m_state->positions.size(); }
std::span<const float> Growth::active(std::size_t o) const {
    return std::as_const(m_state->organisms.at(o).active).span();
}
std::span<const float> Growth::inactive(std::size_t o) const {
    return std::as_const(m_state->organisms.at(o).inactive).span();
}
std::span<const float> Growth::nutrient() const { return std::as_const(m_state->nutrient).span(); }
std::span<const float> Growth::gate() const { return std::as_const(m_state->gate).span(); }
std::span<const float> Growth::areas_m2() const { return std::as_const(m_state->stencil.area_m2).span(); }
std::span<const Vec3> Growth::positions_m() const { return m_state->positions; }

double Growth::total() const {
    return parallel_sum(texel_count(), kTexelsPerTask, [this](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const float inverse_area = m_state->stencil.inverse_area[i];
            if (!(inverse_area > 0)) continue;
            double density = m_state->nutrient[i];
            for (const auto& life : m_state->organisms)
                density += static_cast<double>(life.active[i]) + life.inactive[i];
            sum += density / inverse_area;
        }
        return sum;
    });
}

double Growth::area_over(std::size_t o, double threshold) const {
    const auto& life = m_state->organisms.at(o);
    return parallel_sum(texel_count(), kTexelsPerTask, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i)
            if (life.active[i] + life.inactive[i] >= threshold) sum += m_state->stencil.area_m2[i];
        return sum;
    });
}

double Growth::time_h() const { return m_state->time_h; }
std::uint64_t Growth::step_count() const { return m_state->steps; }
std::uint64_t Growth::pass_count() const { return m_state->passes; }
double Growth::active_share() const { return m_state->active_share(); }
std::vector<std::byte> Growth::save() const { return m_state->save(); }
void Growth::restore(std::span<const std::byte> state) { m_state->restore(state); }

}  // namespace windfall::decay
