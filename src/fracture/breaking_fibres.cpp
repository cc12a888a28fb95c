#include "fracture/breaking_fibres.h"

#include <algorithm>
#include <cmath>

#include "fracture/breaking_guide.h"
#include "fracture/noise.h"

namespace windfall::fracture {

namespace {

/// Distance from both ends at which a node counts as drawn out of its hole, radii.
constexpr double kClearOf = 0.05;

std::size_t slot(int i) { return static_cast<std::size_t>(i); }

}  // namespace

BreakingFibres::BreakingFibres(const FractureParameters& parameters, const BreakEnds& ends,
                               const BreakingLattice& lattice)
    : m_fibres(bridging_fibres(parameters, ends, lattice)) {
    for (const BridgingFibre& fibre : m_fibres) {
        FibreState state{};
        for (std::size_t half = 0; half < 2; ++half)
            for (std::size_t n = 0; n < kHalfNodes; ++n) {
                state.position[half][n] = fibre.tied[half][n].at(lattice.particles);
                state.velocity[half][n] = Point::Zero();
            }
        state.freed = {1, 1};
        state.torn_at = -1;
        states.push_back(state);
    }
}

std::size_t BreakingFibres::bridging() const {
    return slot(static_cast<int>(
        std::count_if(states.begin(), states.end(), [](const FibreState& s) { return s.torn_at < 0; })));
}

double BreakingFibres::stretched(std::size_t fibre) const {
    const FibreState& state = states[fibre];
    if (state.torn_at >= 0) return 1;
    const BridgingFibre& f = m_fibres[fibre];
    return static_cast<double>(state.freed[0] + state.freed[1] - 2) /
           std::max(1, f.most_freed[0] + f.most_freed[1] - 2);
}

void BreakingFibres::peel_or_tear(std::size_t fibre, double weakening, double time) {
    const BridgingFibre& f = m_fibres[fibre];
    FibreState& state = states[fibre];
    const auto segment = [&f](std::size_t half) { return f.length[half] / (kHalfNodes - 1); };
    const auto front = [&state](std::size_t half) {
        return state.position[half][slot(kHalfNodes - 1 - state.freed[half])];
    };
    const double free_length = state.freed[0] * segment(0) + state.freed[1] * segment(1);
    const double strain = (front(0) - front(1)).norm() / free_length - 1;
    // The end that has given less of what it can give gives next.
    const auto left = [&](std::size_t half) { return f.most_freed[half] - state.freed[half]; };
    const std::size_t next = left(0) >= left(1) ? 0 : 1;
    constexpr double kPeeling = 0.015;
    if (left(next) > 0 && strain > kPeeling) {
        ++state.freed[next];
    } else if (strain > f.tearing || weakening < unit_float(mixed_bits(f.name))) {
        state.torn_at = time;
    }
}

void BreakingFibres::relax(std::size_t fibre) {
    const BridgingFibre& f = m_fibres[fibre];
    FibreState& state = states[fibre];
    const auto pull = [](Point& a, double weight_a, Point& b, double weight_b, double rest) {
        const Point apart = b - a;
        const double length = apart.norm();
        if (weight_a + weight_b == 0 || length < 1e-12) return;
        const Point move = (1 - rest / length) / (weight_a + weight_b) * apart;
        a += weight_a * move;
        b -= weight_b * move;
    };
    constexpr int kSweeps = 4;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t half = 0; half < 2; ++half) {
            const double rest = f.length[half] / (kHalfNodes - 1);
            auto& x = state.position[half];
            for (int n = kHalfNodes - state.freed[half]; n < kHalfNodes; ++n) {
                const double before = n == kHalfNodes - state.freed[half] ? 0 : 1;
                pull(x[slot(n) - 1], before, x[slot(n)], 1, rest);
            }
            // While the fibre bridges both tips are one node.
            if (state.torn_at < 0) state.position[1 - half][kHalfNodes - 1] = x[kHalfNodes - 1];
        }
}

void BreakingFibres::curl(std::size_t fibre, int half, const Point& direction, double share) {
    const BridgingFibre& f = m_fibres[fibre];
    auto& x = states[fibre].position[slot(half)];
    const double rest = f.length[slot(half)] / (kHalfNodes - 1);
    for (int n = kHalfNodes - states[fibre].freed[slot(half)]; n < kHalfNodes; ++n) {
        if (n < 2 || states[fibre].clear[slot(half)][slot(n)] == 0) continue;
        const Point along = (x[slot(n) - 1] - x[slot(n) - 2]).normalized() + direction;
        const Point wanted = x[slot(n) - 1] + rest * along.normalized();
        x[slot(n)] += share * (wanted - x[slot(n)]);
    }
}

void BreakingFibres::follow_ends(std::size_t fibre, const Particles& particles, const EndFrame& stub,
                                 const EndFrame& piece, double interlocked) {
    const BridgingFibre& f = m_fibres[fibre];
    FibreState& state = states[fibre];
    for (std::size_t half = 0; half < 2; ++half) {
        const EndFrame& other = half == 0 ? piece : stub;
        const double sense = half == 0 ? -1 : 1;
        for (int n = 0; n < kHalfNodes - state.freed[half]; ++n) {
            Point& x = state.position[half][slot(n)];
            x = f.tied[half][slot(n)].at(particles);
            // In a splinter that stays in the other end's hole.
            const Point local = other.unplaced(x);
            const double depth = sense * (f.mouth - local.z());
            const Point back =
                point(f.channel[1 - half].x() - local.x(), f.channel[1 - half].y() - local.y(), 0);
            // A splinter that is twisted far out of its hole has broken off in it.
            const double broken = smooth_step(0.4F, 0.8F, static_cast<float>(back.norm()));
            x += interlocked * SplinterGuide::held(depth) * (1 - broken) * other.turned(back);
        }
    }
}

void BreakingFibres::advance(const BreakingLattice& lattice, const Particles& particles, const EndFrame& stub,
                             const EndFrame& piece, double step, double time, double weakening,
                             double interlocked) {
    const double pace = std::sqrt(lattice.gravity);  // of falling and swinging, 1/s
    const double drag = std::exp(-1.5 * pace * step), stiffness = 1 - std::exp(-6 * pace * step);
    for (std::size_t i = 0; i < m_fibres.size(); ++i) {
        FibreState& state = states[i];
        const auto before = state.position;
        follow_ends(i, particles, stub, piece, interlocked);
        for (std::size_t half = 0; half < 2; ++half)
            for (int n = kHalfNodes - state.freed[half]; n < kHalfNodes; ++n) {
                Point& v = state.velocity[half][slot(n)];
                v *= drag;
                v.z() -= step * lattice.gravity;
                state.position[half][slot(n)] += step * v;
            }
        if (state.torn_at < 0) {
            state.position[1].back() = state.position[0].back();
            peel_or_tear(i, weakening, time);
        } else {
            curl(i, 0, stub.turned(m_fibres[i].curl), stiffness);
            curl(i, 1, piece.turned(m_fibres[i].curl), stiffness);
        }
        relax(i);
        collide(i, lattice, stub, piece);
        for (std::size_t half = 0; half < 2; ++half)
            for (std::size_t n = 0; n < kHalfNodes; ++n)
                state.velocity[half][n] = (state.position[half][n] - before[half][n]) / step;
    }
}

void BreakingFibres::collide(std::size_t fibre, const BreakingLattice& lattice, const EndFrame& stub,
                             const EndFrame& piece) {
    const BridgingFibre& f = m_fibres[fibre];
    FibreState& state = states[fibre];
    for (std::size_t half = 0; half < 2; ++half)
        for (int n = kHalfNodes - state.freed[half]; n < kHalfNodes; ++n) {
            Point& x = state.position[half][slot(n)];
            const Inside in_stub = inside_stub(lattice, stub, x), in_piece = inside_piece(lattice, piece, x);
            std::uint8_t& is_clear = state.clear[half][slot(n)];
            if (std::max(in_stub.depth, in_piece.depth) < -kClearOf) is_clear = 1;
            if (is_clear != 0) {
                if (in_stub.depth > 0) x += in_stub.depth * in_stub.way_out;
                if (in_piece.depth > 0) x += in_piece.depth * in_piece.way_out;
            } else {
                // Not yet drawn out of its hole, in which it cannot go sideways.
                const auto hold = [&x, &f](const EndFrame& frame, const Point& channel, double sense) {
                    const Point local = frame.unplaced(x);
                    if (sense * (f.surface.z() - local.z()) > 0)
                        x += frame.turned(point(channel.x() - local.x(), channel.y() - local.y(), 0));
                };
                // Once it is torn, only its own end's hole.
                if (half == 0 || state.torn_at < 0) hold(stub, f.channel[0], 1);
                if (half == 1 || state.torn_at < 0) hold(piece, f.channel[1], -1);
            }
            // A loose half must not be stretched by what it is pushed out of.
            const Point& before = state.position[half][slot(n - 1)];
            const double length = (x - before).norm(), longest = 1.05 * f.length[half] / (kHalfNodes - 1);
            if (state.torn_at >= 0 && length > longest) x = before + longest / length * (x - before);
            x.z() = std::max(x.z(), lattice.ground + f.radius);
        }
}

}  // namespace windfall::fracture
