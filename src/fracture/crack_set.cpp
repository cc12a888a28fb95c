#include "fracture/crack_set.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "fracture/noise.h"
#include "fracture/species.h"

namespace windfall::fracture {
namespace {

constexpr double kLeastShare = 0.25;         // of its length that must be left to a crack that is shortened
constexpr double kWidest = 0.2;              // half opening over length
constexpr double kBarkMargin = 0.01;         // between cracks and the inner bark
constexpr double kLongestRing = 0.8;         // turns; a ring that closed would let the heart fall out
constexpr double kBorderProbability = 0.35;  // of a tangential crack to run between heartwood and sapwood

enum class CrackNumber : std::uint32_t { Start, Angle, Begin, Length, Depth, Width, Border };

struct ClassOfCracks {
    CrackRank rank;
    CrackClass asked;
    double first_begin, last_begin;  // where along the ray (tangential: at which radius) its cracks begin
};

double wrapped(double angle) { return angle - kTwoPi<double> * std::floor(angle / kTwoPi<double>); }

/// The difference of two angles, in -pi .. pi.
double turned(double angle) { return angle - kTwoPi<double> * std::round(angle / kTwoPi<double>); }

struct Interval {
    double low, high;
};

class CrackDrawer {
  public:
    CrackDrawer(const FractureParameters& p, const CrackRoom& room)
        : m_p(p), m_room(room), m_seed(noise_seed(p.seed)), m_wet(moisture_effect(p.species.moisture)) {
        m_wood = 1 - p.tissue.phloem - kBarkMargin;
    }

    CrackSet draw() {
        if (m_p.cracks.check && check_opening(m_p) > 0) add_check();
        add_class({CrackRank::Large, m_p.cracks.large, 0.02, 0.08});
        add_class({CrackRank::Medium, m_p.cracks.medium, 0.12, 0.5});
        add_class({CrackRank::Tangential, m_p.cracks.tangential, 0.3, 0.85});
        add_class({CrackRank::Small, m_p.cracks.small, 0.3, 0.75});
        return std::move(m_set);
    }

  private:
    double number(const ClassOfCracks& c, CrackNumber which, std::uint32_t index) const {
        return random_unit(m_seed, NoisePurpose::Crack, index, static_cast<std::uint32_t>(which),
                           static_cast<std::uint32_t>(c.rank));
    }

    void add_check() {
        Crack check;
        check.rank = CrackRank::Check;
        check.line = wrapped(m_p.cracks.check_angle_deg * kTwoPi<double> / 360);
        check.begin = 0.02;
        check.end = 1;
        check.depth = m_p.cracks.check_depth * m_wet.crack_depth;
        check.half_width = 0.5 * check_opening(m_p);
        ++m_set.count.asked;
        ++m_set.count.opened;
        m_set.cracks.push_back(check);
    }

    void add_class(const ClassOfCracks& c) {
        const auto count =
            static_cast<std::uint32_t>(std::llround(static_cast<double>(c.asked.count) * m_wet.crack_count));
        if (count == 0) return;
        const double even = kTwoPi<double> / count;
        const double gap =
            c.asked.gap_deg > 0 ? std::min(even, c.asked.gap_deg * kTwoPi<double> / 360) : even;
        const double start = kTwoPi<double> * number(c, CrackNumber::Start, 0);
        for (std::uint32_t k = 0; k < count; ++k) {
            Crack crack;
            crack.rank = c.rank;
            crack.index = k;
            const double angle = wrapped(start + gap * (k + 0.6 * (number(c, CrackNumber::Angle, k) - 0.5)));
            const double length = c.asked.length * (0.5 + number(c, CrackNumber::Length, k));
            crack.depth = c.asked.depth * m_wet.crack_depth * (0.5 + number(c, CrackNumber::Depth, k));
            crack.half_width = c.asked.width * m_wet.crack_width * (0.5 + number(c, CrackNumber::Width, k));
            if (crack.radial())
                lay_along_ray(c, angle, length, crack);
            else
                lay_along_ring(c, angle, length, crack);
            ++m_set.count.asked;
            place(crack);
        }
    }

    void lay_along_ray(const ClassOfCracks& c, double angle, double length, Crack& crack) const {
        const double last = std::clamp(m_wood - length, c.first_begin, c.last_begin);
        crack.line = angle;
        crack.begin = c.first_begin + (last - c.first_begin) * number(c, CrackNumber::Begin, crack.index);
        crack.end = std::min(m_wood, crack.begin + length);
    }

    void lay_along_ring(const ClassOfCracks& c, double angle, double length, Crack& crack) const {
        const double border = m_p.tissue.pith + m_p.tissue.heartwood;
        const bool has_border = m_p.tissue.heartwood > 0 && border > 0.15 && border < m_wood;
        const bool at_border = has_border && number(c, CrackNumber::Border, crack.index) < kBorderProbability;
        const double free_radius =
            c.first_begin + (c.last_begin - c.first_begin) * number(c, CrackNumber::Begin, crack.index);
        crack.line = at_border ? border : free_radius * std::max(0.0, m_wood);
        const double angles =
            crack.line > 0 ? std::min(length / crack.line, kLongestRing * kTwoPi<double>) : 0;
        crack.begin = wrapped(angle - 0.5 * angles);
        crack.end = crack.begin + angles;
    }

    void place(Crack& crack) {
        const double length = crack.end - crack.begin;
        const Interval free = longest_free(crack);
        if (!(length > 0) || free.high - free.low < kLeastShare * length) {
            ++m_set.count.dropped;
            return;
        }
        ++m_set.count.opened;
        if (free.high - free.low < length) {
            ++m_set.count.shortened;
            crack.half_width *= (free.high - free.low) / length;  // a short crack opens less
        }
        crack.begin = free.low;
        crack.end = free.high;
        if (limit_width(crack)) ++m_set.count.narrowed;
        m_set.cracks.push_back(crack);
    }

    Interval longest_free(const Crack& crack) const {
        std::vector<Interval> blocked;
        for (const Crack& other : m_set.cracks) {
            if (crack.radial())
                other.radial() ? block_ray_by_ray(crack, other, blocked)
                               : block_ray_by_ring(crack, other, blocked);
            else
                other.radial() ? block_ring_by_ray(crack, other, blocked)
                               : block_ring_by_ring(crack, other, blocked);
        }
        std::sort(blocked.begin(), blocked.end(),
                  [](const Interval& a, const Interval& b) { return a.low < b.low; });
        Interval best{crack.begin, crack.begin};
        double free_from = crack.begin;
        blocked.push_back({crack.end, crack.end});
        for (const Interval& b : blocked) {
            const double free_to = std::min(b.low, crack.end);
            if (free_to - free_from > best.high - best.low) best = {free_from, free_to};
            free_from = std::max(free_from, b.high);
        }
        return best;
    }

    double angle_room(double radius) const {
        return std::max(m_room.least_angle, m_room.along_ring / std::max(radius, 1e-6));
    }

    void block_ray_by_ray(const Crack& crack, const Crack& other, std::vector<Interval>& blocked) const {
        const double apart = std::abs(turned(crack.line - other.line));
        const double near =
            apart < m_room.least_angle ? other.end + m_room.along_ray : m_room.along_ring / apart;
        const Interval b{other.begin - m_room.along_ray, std::min(other.end + m_room.along_ray, near)};
        if (b.low < b.high) blocked.push_back(b);
    }

    void block_ray_by_ring(const Crack& crack, const Crack& other, std::vector<Interval>& blocked) const {
        const double middle = 0.5 * (other.begin + other.end);
        const double apart = std::abs(turned(crack.line - middle));
        if (apart < 0.5 * (other.end - other.begin) + angle_room(other.line))
            blocked.push_back({other.line - m_room.along_ray, other.line + m_room.along_ray});
    }

    void block_ring_by_ray(const Crack& crack, const Crack& other, std::vector<Interval>& blocked) const {
        if (crack.line < other.begin - m_room.along_ray || crack.line > other.end + m_room.along_ray) return;
        const double middle = 0.5 * (crack.begin + crack.end);
        const double at = middle + turned(other.line - middle), room = angle_room(crack.line);
        for (const double turn : {-kTwoPi<double>, 0.0, kTwoPi<double>})
            blocked.push_back({at + turn - room, at + turn + room});
    }

    void block_ring_by_ring(const Crack& crack, const Crack& other, std::vector<Interval>& blocked) const {
        if (std::abs(crack.line - other.line) > m_room.along_ray) return;
        const double middle = 0.5 * (crack.begin + crack.end);
        const double at = middle + turned(0.5 * (other.begin + other.end) - middle);
        const double half = 0.5 * (other.end - other.begin) + angle_room(crack.line);
        for (const double turn : {-kTwoPi<double>, 0.0, kTwoPi<double>})
            blocked.push_back({at + turn - half, at + turn + half});
    }

    const FractureParameters& m_p;
    const CrackRoom& m_room;
    std::uint32_t m_seed;
    MoistureEffect m_wet;
    double m_wood = 0;  // radius of the wood
    CrackSet m_set;
};

}  // namespace

bool limit_width(Crack& crack) {
    const double length = crack.end - crack.begin;
    const double widest =
        crack.radial() ? kWidest * length / (0.5 * (crack.begin + crack.end)) : kWidest * length * crack.line;
    if (crack.half_width <= widest) return false;
    crack.half_width = widest;
    crack.narrowed = true;
    return true;
}

double check_opening(const FractureParameters& parameters) {
    const WoodProperties wood = wood_properties(parameters.species);
    const double difference = std::max(0.0, wood.shrinkage_tangential - wood.shrinkage_radial);
    return difference * kTwoPi<double> * parameters.cracks.check_relief *
           moisture_effect(parameters.species.moisture).crack_width;
}

CrackSet draw_cracks(const FractureParameters& parameters, const CrackRoom& room) {
    return CrackDrawer(parameters, room).draw();
}

}  // namespace windfall::fracture
