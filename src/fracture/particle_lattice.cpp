#include "fracture/particle_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace windfall::fracture {

namespace {

/// Room that is not filled by an end's wood still carries its discs, lightly.
constexpr double kEmptyShare = 0.1;

/// The springs between the particles of one end.
class SpringMaker {
  public:
    SpringMaker(const LatticeEnd& end, const DiscPlan& plan, const LatticeMaterial& material,
                const std::vector<double>& shares, std::vector<Spring>& springs)
        : m_end(end), m_plan(plan), m_material(material), m_shares(shares), m_springs(springs) {}

    void fibres(int level, double height) {
        for (std::size_t c = 0; c < m_plan.size(); ++c)
            add(m_end.at(level, c), m_end.at(level + 1, c), m_material.along * m_plan.area(c) / height);
    }

    /// Links on rings and rays of one disc, each standing for `height` of it, and the diagonals of its cells.
    void disc(int level, double height) {
        const double ray = 1.0 / m_plan.rings();
        for (int r = 1; r <= m_plan.rings(); ++r) {
            const double depth = r < m_plan.rings() ? ray : ray / 2;
            const double arc = arc_of(r), middle_arc = arc_of(r - 0.5);
            for (int s = 0; s < m_plan.sectors(); ++s) {
                const std::size_t here = at(level, r, s), next = at(level, r, s + 1);
                const std::size_t inner = at(level, r - 1, s), inner_next = at(level, r - 1, s + 1);
                add(here, next, m_material.across * depth * height / arc);
                add(inner, here, m_material.across * middle_arc * height / ray);
                if (r == 1) continue;  // triangles need no diagonal
                const double stiffness = diagonal(middle_arc, ray, height);
                add(inner, next, stiffness);
                add(inner_next, here, stiffness);
            }
        }
    }

    /// Diagonals of the cells' faces along the fibres, between a disc and the next one.
    void along_diagonals(int level, double height) {
        const double ray = 1.0 / m_plan.rings();
        for (int r = 1; r <= m_plan.rings(); ++r) {
            const double depth = r < m_plan.rings() ? ray : ray / 2;
            const double on_ring = diagonal(arc_of(r), height, depth);
            const double on_ray = diagonal(ray, height, arc_of(r - 0.5));
            for (int s = 0; s < m_plan.sectors(); ++s) {
                add(at(level, r, s), at(level + 1, r, s + 1), on_ring);
                add(at(level, r, s + 1), at(level + 1, r, s), on_ring);
                add(at(level, r - 1, s), at(level + 1, r, s), on_ray);
                add(at(level, r, s), at(level + 1, r - 1, s), on_ray);
            }
        }
    }

  private:
    double arc_of(double ring) const {
        return 2 * std::numbers::pi * ring / m_plan.rings() / m_plan.sectors();
    }
    std::size_t at(int level, int ring, int sector) const {
        return m_end.at(level, m_plan.column(ring, sector));
    }

    /// Of two crossed springs in a face a x b, `depth` thick, that together have the shear modulus:
    /// shear g stretches each by g a b / d, and 2 k (g a b / d)^2 / 2 = G g^2 (a b depth) / 2.
    double diagonal(double a, double b, double depth) const {
        return m_material.shear * depth * (a * a + b * b) / (2 * a * b);
    }

    void add(std::size_t a, std::size_t b, double stiffness) {
        const double share = std::min(m_shares[a - m_end.first], m_shares[b - m_end.first]);
        m_springs.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), stiffness * share});
    }

    const LatticeEnd& m_end;
    const DiscPlan& m_plan;
    const LatticeMaterial& m_material;
    const std::vector<double>& m_shares;
    std::vector<Spring>& m_springs;
};

}  // namespace

DiscPlan::DiscPlan(int rings, int sectors) : m_rings(rings), m_sectors(sectors) {
    const auto add = [this](int ring, double angle, double area) {
        const double radius = static_cast<double>(ring) / m_rings;
        m_x.push_back(radius * std::cos(angle));
        m_y.push_back(radius * std::sin(angle));
        m_area.push_back(area);
        m_ring.push_back(ring);
    };
    const double cell = std::numbers::pi / (rings * rings);
    add(0, 0, cell / 4);
    for (int r = 1; r <= rings; ++r) {
        const double outer = r < rings ? r + 0.5 : r;
        const double area = cell * (outer * outer - (r - 0.5) * (r - 0.5)) / sectors;
        for (int s = 0; s < sectors; ++s) add(r, 2 * std::numbers::pi * s / sectors, area);
    }
}

std::size_t DiscPlan::column(int ring, int sector) const {
    if (ring == 0) return 0;
    const int wrapped = ((sector % m_sectors) + m_sectors) % m_sectors;
    return static_cast<std::size_t>(1 + (ring - 1) * m_sectors + wrapped);
}

std::size_t DiscPlan::nearest(double x, double y) const {
    const int ring = std::min(m_rings, static_cast<int>(std::lround(std::hypot(x, y) * m_rings)));
    return column(ring, static_cast<int>(std::lround(std::atan2(y, x) / (2 * std::numbers::pi) * m_sectors)));
}

double DiscPlan::interpolate(const std::vector<double>& values, double x, double y) const {
    const double ring = std::min(std::hypot(x, y), 1.0) * m_rings;
    const double sector = std::atan2(y, x) / (2 * std::numbers::pi) * m_sectors;
    const int r = std::min(static_cast<int>(ring), m_rings - 1), s = static_cast<int>(std::floor(sector));
    const double u = ring - r, v = sector - s;
    const auto on_ring = [&](int at) {
        return (1 - v) * values[column(at, s)] + v * values[column(at, s + 1)];
    };
    return (1 - u) * on_ring(r) + u * on_ring(r + 1);
}

void add_lattice(LatticeEnd& end, const DiscPlan& plan, const std::vector<double>& levels,
                 const LatticeMaterial& material, const Filling& filling, const RestShape& shape,
                 bool clamped, Particles& particles, std::vector<Spring>& springs) {
    end.first = particles.size();
    end.columns = plan.size();
    const auto height_of = [&](int level) {
        const auto k = static_cast<std::size_t>(level);
        const double above = level < end.last_level ? levels[k + 1] - levels[k] : 0;
        const double below = level > end.first_level ? levels[k] - levels[k - 1] : 0;
        return (above + below) / 2;
    };
    std::vector<Eigen::Vector3f> rest;
    for (int k = end.first_level; k <= end.last_level; ++k)
        for (std::size_t c = 0; c < plan.size(); ++c)
            rest.emplace_back(
                Eigen::Vector3d(plan.x(c), plan.y(c), levels[static_cast<std::size_t>(k)]).cast<float>());
    shape(rest);
    std::vector<double> stiffness;
    for (int k = end.first_level; k <= end.last_level; ++k)
        for (std::size_t c = 0; c < plan.size(); ++c) {
            const Eigen::Vector3f& at = rest[stiffness.size()];
            const CellShare share = filling(k, c);
            stiffness.push_back(std::max(share.stiffness, kEmptyShare));
            const bool held = clamped && k == end.first_level;
            const double mass = plan.area(c) * height_of(k) * std::max(share.mass, kEmptyShare);
            particles.add(point(at.x(), at.y(), at.z()), held ? 0 : mass);
        }
    SpringMaker maker(end, plan, material, stiffness, springs);
    for (int k = end.first_level; k <= end.last_level; ++k) {
        maker.disc(k, height_of(k));
        if (k == end.last_level) continue;
        const double height = levels[static_cast<std::size_t>(k) + 1] - levels[static_cast<std::size_t>(k)];
        maker.fibres(k, height);
        maker.along_diagonals(k, height);
    }
}

}  // namespace windfall::fracture
