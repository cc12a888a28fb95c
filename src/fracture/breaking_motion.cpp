#include "fracture/breaking_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fracture/noise.h"

namespace windfall::fracture {

namespace {

/// Fibres move in steps this many times as long as those of the stiff lattice; so does the damping.
constexpr int kSlowSteps = 4;
/// How fast the ground stills what it throws back, in falling times of a radius.
constexpr double kBounceLoss = 5;
/// The branch is at rest when it has been slow at this many looks.
constexpr int kLooks = 6, kStepsPerLook = 64;

/// How long it is pushed: the fall and the coming to rest need their time at the end.
double push_seconds(const BreakingLattice& lattice, double seconds) {
    double height = 0;
    for (double h : lattice.heights) height += h / static_cast<double>(lattice.heights.size());
    const double fall = std::sqrt(2 * std::max(0.0, height - lattice.ground) / lattice.gravity);
    return std::clamp(seconds - 6 * fall, 0.35 * seconds, 0.85 * seconds);
}

std::vector<float> heights_of(const BranchMesh& mesh) {
    std::vector<float> heights;
    for (const Vector3f& p : mesh.positions) heights.push_back(p.z());
    return heights;
}

std::vector<Vector3f> shaped(std::vector<Vector3f> points, const RestShape& shape) {
    shape(points);
    return points;
}

}  // namespace

BranchBreaking::BranchBreaking(const FractureParameters& parameters, const BreakEnds& ends,
                               const RestShape& shape)
    : m_lattice(make_breaking_lattice(parameters, ends, shape)),
      m_bonds(parameters, m_lattice),
      m_load(parameters, m_lattice, push_seconds(m_lattice, parameters.output.seconds)),
      m_fibres(parameters, ends, m_lattice),
      m_ground(m_lattice),
      m_contact(m_lattice),
      m_stub_skin(m_lattice, m_lattice.stub, heights_of(ends.stub), shaped(ends.stub.positions, shape)),
      m_piece_skin(m_lattice, m_lattice.piece, heights_of(ends.piece), shaped(ends.piece.positions, shape)),
      m_stub_guide(m_lattice, ends, true, m_stub_skin.rest()),
      m_piece_guide(m_lattice, ends, false, m_piece_skin.rest()),
      m_fibre_mesh(fibre_mesh(parameters, m_fibres)),
      m_seconds(parameters.output.seconds),
      m_frames(static_cast<int>(parameters.output.frames)),
      m_particles(m_lattice.particles) {}

int BranchBreaking::step_of(int frame) const {
    if (m_frames < 2) return 0;
    return static_cast<int>(std::lround(static_cast<double>(m_lattice.steps) * frame / (m_frames - 1)));
}

double BranchBreaking::weakening(double time) const {
    // What still holds when the push is over creeps until it lets go.
    return std::exp(-std::max(0.0, time - m_load.seconds()) / (0.05 * m_seconds));
}

void BranchBreaking::damp() {
    // Bending waves die away within two swings or so; the motion of the piece as a whole stays.
    const double share = 1 - std::exp(-kSlowSteps * m_lattice.step * m_lattice.wave_speed / 100);
    damp_relative(m_particles, m_lattice.piece.first, m_lattice.piece.past(), share);
    for (std::size_t i = m_lattice.stub.first; i < m_lattice.stub.past(); ++i)
        m_particles.velocity[i] *= 1 - share;
    if (m_ground.touching() == 0) return;
    // Bark and earth swallow most of a bounce, and what lies on them soon stops rolling.
    const double pace = std::sqrt(m_lattice.gravity) * kSlowSteps * m_lattice.step;
    const double rolling = std::exp(-1.6 * pace), bouncing = std::exp(-kBounceLoss * pace);
    for (std::size_t i = m_lattice.piece.first; i < m_lattice.piece.past(); ++i) {
        m_particles.velocity[i] *= rolling;
        if (m_particles.velocity[i].z() > 0) m_particles.velocity[i].z() *= bouncing;
    }
}

void BranchBreaking::step() {
    const double step = m_lattice.step, time = step * (m_steps_done + 1);
    const bool slow = (m_steps_done + 1) % kSlowSteps == 0;
    if (m_bonds.holding() > 0) m_load.twist(m_particles, step);
    predict(m_particles, point(0, 0, -m_lattice.gravity), step);
    project(m_lattice.constraints, m_particles);
    if (m_bonds.holding() > 0) {
        m_bonds.project(m_particles);
        m_load.project(m_particles, time, step);
    }
    const EndFrame stub = EndFrame::of(m_lattice, m_lattice.stub, m_particles);
    const EndFrame piece = EndFrame::of(m_lattice, m_lattice.piece, m_particles);
    m_contact.project(m_lattice, stub, piece, m_particles);
    m_ground.project(m_particles);
    update_velocities(m_particles, step);
    const double bend = bend_between(stub, piece);
    m_bonds.yield(m_particles, bend, weakening(time), time);
    if (slow) {
        damp();
        m_fibres.advance(m_lattice, m_particles, stub, piece, kSlowSteps * step, time, weakening(time),
                         interlocking(bend));
    }
    ++m_steps_done;
}

void BranchBreaking::fall_asleep_if_still() {
    double fastest = 0;
    for (const Point& v : m_particles.velocity) fastest = std::max(fastest, v.squaredNorm());
    const double slow = 0.03 * std::sqrt(m_lattice.gravity);
    const bool still = m_bonds.holding() == 0 && m_fibres.bridging() == 0 && fastest < slow * slow;
    m_still = still ? m_still + 1 : 0;
}

void BranchBreaking::advance_to(int frame, const RunContext& context) {
    const int past = step_of(std::min(frame, m_frames - 1));
    while (m_steps_done < past) {
        if (m_still >= kLooks) {
            m_steps_done = past;
            break;
        }
        step();
        if (m_steps_done % kStepsPerLook == 0) {
            fall_asleep_if_still();
            context.throw_if_cancelled();
        }
    }
    for (const Point& x : m_particles.position)
        if (!x.allFinite())
            throw RunError(
                "the motion of the breaking branch was lost: try another output.seconds or a shorter branch");
    m_frame = std::max(m_frame, std::min(frame, m_frames - 1));
}

double BranchBreaking::interlocking(double bend) const {
    double last_torn = 0;
    for (double at : m_bonds.torn_at) last_torn = std::max(last_torn, at);
    const double apart = m_bonds.holding() > 0
                             ? 0.0
                             : (m_lattice.step * m_steps_done - last_torn) * std::sqrt(m_lattice.gravity);
    return (1 - smooth_step(1.0F, 1.7F, static_cast<float>(bend))) *
           (1 - smooth_step(0.0F, 1.5F, static_cast<float>(apart)));
}

BreakingFrame BranchBreaking::frame() const {
    BreakingFrame result;
    const EndFrame stub = EndFrame::of(m_lattice, m_lattice.stub, m_particles);
    const EndFrame piece = EndFrame::of(m_lattice, m_lattice.piece, m_particles);
    const double bend = bend_between(stub, piece);
    result.time = m_lattice.step * step_of(m_frame);
    const std::vector<DiscMotion> stub_discs = disc_motions(m_lattice, m_lattice.stub, m_particles);
    const std::vector<DiscMotion> piece_discs = disc_motions(m_lattice, m_lattice.piece, m_particles);
    result.stub = m_stub_skin.positions(m_lattice, stub_discs);
    result.piece = m_piece_skin.positions(m_lattice, piece_discs);
    const double share = interlocking(bend);
    const auto middle =
        static_cast<std::size_t>((m_lattice.piece.first_level + m_lattice.stub.last_level) / 2);
    m_stub_guide.apply(piece_discs[middle - static_cast<std::size_t>(m_lattice.piece.first_level)], share,
                       result.stub);
    m_piece_guide.apply(stub_discs[middle - static_cast<std::size_t>(m_lattice.stub.first_level)], share,
                        result.piece);
    result.fibres = fibre_positions(m_fibres, m_lattice.ground);
    result.bonds_holding = static_cast<double>(m_bonds.holding()) / static_cast<double>(m_bonds.size());
    result.fibres_bridging =
        static_cast<double>(m_fibres.bridging()) / static_cast<double>(m_fibres.fibres().size());
    result.bend_deg = bend * 180 / std::numbers::pi;
    return result;
}

}  // namespace windfall::fracture
