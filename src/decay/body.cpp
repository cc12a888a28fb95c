#include "decay/body.h"

#include <algorithm>

#include "decay/body_archive.h"
#include "decay/body_measure.h"
#include "decay/body_parts.h"

namespace windfall::decay {

namespace {

constexpr std::uint64_t kStateVersion = 0x57464259'00000001U;
constexpr int kSettleSteps = 150;
constexpr int kRampSteps = 60;
constexpr double kStandardGravity_m_s2 = 9.81;

}  // namespace

Body::Body(const SurfaceFunction& surface, const BodySettings& settings, const InteriorFunction& interior)
    : m_parts(std::make_unique<Parts>(surface, settings, interior)) {}
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;
Body::~Body() = default;

void Body::settle(const RunContext& run) {
    m_parts->translate({0, 0, -static_cast<float>(lowest_m())});
    for (int step = 1; step <= kSettleSteps; ++step) {
        run.throw_if_cancelled();
        m_parts->settle_step(kStandardGravity_m_s2 * std::min(1.0, static_cast<double>(step) / kRampSteps));
        run.progress({"settling", static_cast<double>(step), kSettleSteps, -1, ""});
    }
    m_parts->finish_settling();
}

void Body::advance(const BodyLoad& load) { m_parts->advance(load); }

const std::vector<Eigen::Vector3f>& Body::skin() const { return m_parts->skin.positions(); }
const std::vector<Eigen::Vector3f>& Body::flesh() const { return m_parts->flesh; }
const std::vector<Eigen::Vector3f>& Body::rest() const { return m_parts->rest; }
const std::vector<geometry::Vec3>& Body::directions() const { return m_parts->directions; }
const std::vector<geometry::Face>& Body::faces() const { return m_parts->faces; }

double Body::volume_m3() const { return surface_volume_m3(skin(), faces()); }
double Body::area_m2() const { return surface_area_m2(skin(), faces()); }

double Body::lowest_m() const {
    const auto lower = [](const auto& a, const auto& b) { return a.z() < b.z(); };
    return std::min_element(skin().begin(), skin().end(), lower)->z();
}

double Body::height_m() const {
    const auto lower = [](const auto& a, const auto& b) { return a.z() < b.z(); };
    return std::max_element(skin().begin(), skin().end(), lower)->z() - lowest_m();
}

double Body::skin_thickness_m() const { return m_parts->skin_material.thickness_m; }
double Body::wave_length_m() const { return m_parts->skin_material.wave_length_m; }

int Body::inverted() const { return m_parts->solver.energy().inverted(m_parts->solver.positions()); }
int Body::crossing_edges() const { return decay::crossing_edges(skin(), faces()); }

std::vector<std::int32_t> Body::touching(double gap_m) const {
    std::vector<std::int32_t> result;
    const auto& neighbours = m_parts->neighbours.skin;
    for (std::size_t i = 0; i < skin().size(); ++i) {
        const bool at_ground = m_parts->ground(skin()[i]).gap_m(skin()[i]) < gap_m;
        const bool at_neighbour = !neighbours.empty() && neighbours[i].gap_m(skin()[i]) < gap_m;
        if (at_ground || at_neighbour) result.push_back(static_cast<std::int32_t>(i));
    }
    return result;
}

std::vector<std::byte> Body::save() const {
    BodyWriter writer;
    writer(kStateVersion);
    m_parts->serialise(writer);
    return writer.take();
}

void Body::restore(std::span<const std::byte> state) {
    BodyReader reader(state);
    std::uint64_t version = 0;
    reader(version);
    if (version != kStateVersion)
        throw InputError("the saved state of the body is of another version; start the run again");
    m_parts->serialise(reader);
    if (!reader.at_end()) throw InputError("the saved state of the body is of another body");
    m_parts->find_flesh();
}

}  // namespace windfall::decay
