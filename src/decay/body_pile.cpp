#include "decay/body_pile.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/body_parts.h"

namespace windfall::decay {

namespace {

constexpr int kPileSettleSteps = 200;
constexpr int kPileRampSteps = 60;
/// Fruit in a pile lose what holds them: so strong a damping lets them fall 3 mm a frame, not metres.
constexpr double kPileDamping_s2 = 3000;
/// Other fruit farther away than this are not seen: where the skin no longer minds them (see Skin).
constexpr float kSight_m = 0.007F;

}  // namespace

BodyPile::BodyPile(std::vector<Body> bodies, Ground ground)
    : m_bodies(std::move(bodies)), m_ground(std::move(ground)) {
    for (Body& body : m_bodies) body.m_parts->ground = m_ground;
    if (m_bodies.size() > 1) set_damping(kPileDamping_s2);
    look_at_all();
}

void BodyPile::set_damping(double per_s2) {
    for (Body& body : m_bodies) body.m_parts->solver.energy().set_damping(per_s2);
}

void BodyPile::look_at_all() {
    m_surfaces.clear();
    for (std::size_t i = 0; i < m_bodies.size(); ++i) m_surfaces.push_back(surface_of(i));
}

NearSurface BodyPile::surface_of(std::size_t body) const {
    const Body::Parts& parts = *m_bodies[body].m_parts;
    return {parts.target, parts.faces, kSight_m};
}

void BodyPile::look_around(std::size_t body) {
    if (m_bodies.size() == 1) return;
    Body::Parts& parts = *m_bodies[body].m_parts;
    parts.neighbours.flesh.assign(parts.mesh.columns(), {});
    parts.neighbours.skin.assign(parts.target.size(), {});
    std::vector<Eigen::Vector3f> flesh(parts.mesh.columns());
    for (std::size_t i = 0; i < flesh.size(); ++i) flesh[i] = parts.solver.positions()[i].head<3>();
    for (std::size_t other = 0; other < m_bodies.size(); ++other) {
        if (other == body) continue;
        const NearSurface& surface = m_surfaces[other];
        const auto see = [&](const std::vector<Eigen::Vector3f>& points, std::vector<ContactPlane>& planes) {
            parallel_blocks(points.size(), 512, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const ContactPlane plane = surface.half_way(points[i]);
                    if (plane.gap_m(points[i]) < planes[i].gap_m(points[i])) planes[i] = plane;
                }
            });
        };
        see(flesh, parts.neighbours.flesh);
        see(parts.target, parts.neighbours.skin);
    }
}

void BodyPile::settle(const RunContext& run) {
    // Nothing holds them until they have come down to the ground.
    set_damping(kPileDamping_s2);
    for (int step = 1; step <= kPileSettleSteps; ++step) {
        run.throw_if_cancelled();
        const double ramp = std::min(1.0, static_cast<double>(step) / kPileRampSteps);
        for (std::size_t i = 0; i < m_bodies.size(); ++i) {
            look_around(i);
            m_bodies[i].m_parts->settle_step(9.81 * ramp);
            m_surfaces[i] = surface_of(i);
        }
        run.progress({"settling", static_cast<double>(step), kPileSettleSteps, -1, ""});
    }
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        look_around(i);
        m_bodies[i].m_parts->finish_settling();
    }
    if (m_bodies.size() == 1) set_damping(FleshConstants{}.damping_s2);
}

void BodyPile::advance(std::span<const BodyLoad> loads) {
    if (loads.size() != m_bodies.size())
        throw InputError(fmt::format("{} loads for a pile of {} fruit", loads.size(), m_bodies.size()));
    look_at_all();  // anew: a body may have been restored
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        look_around(i);
        m_bodies[i].advance(loads[i]);
        m_surfaces[i] = surface_of(i);
    }
}

std::vector<ContactPatch> BodyPile::patches(double gap_m) const {
    std::vector<ContactPatch> result;
    const auto add = [&](int body, int other, const auto& near) {
        ContactPatch patch{body, other, {}};
        const auto& skin = m_bodies[body].skin();
        for (std::size_t v = 0; v < skin.size(); ++v)
            if (near(skin[v]) < gap_m) patch.vertices.push_back(static_cast<std::int32_t>(v));
        if (!patch.vertices.empty()) result.push_back(std::move(patch));
    };
    const int count = static_cast<int>(m_bodies.size());
    for (int body = 0; body < count; ++body)
        add(body, -1, [&](const Eigen::Vector3f& x) { return m_ground(x).gap_m(x); });
    for (int other = 0; other < count; ++other) {
        const MeasuredSurface surface(m_bodies[other].skin(), m_bodies[other].faces(), kSight_m);
        for (int body = 0; body < count; ++body)
            if (body != other)
                add(body, other, [&](const Eigen::Vector3f& x) { return surface.signed_distance_m(x); });
    }
    std::sort(result.begin(), result.end(), [](const ContactPatch& a, const ContactPatch& b) {
        return std::pair(a.body, a.other) < std::pair(b.body, b.other);
    });
    return result;
}

double BodyPile::deepest_overlap_m() const {
    double deepest = 0;
    for (std::size_t other = 0; other < m_bodies.size(); ++other) {
        const MeasuredSurface surface(m_bodies[other].skin(), m_bodies[other].faces(), kSight_m);
        for (std::size_t body = 0; body < m_bodies.size(); ++body) {
            if (body == other) continue;
            for (const auto& x : m_bodies[body].skin())
                deepest = std::max(deepest, -static_cast<double>(surface.signed_distance_m(x)));
        }
    }
    return deepest;
}

}  // namespace windfall::decay
