#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fracture/bending.h"
#include "fracture/break_buffers.h"
#include "fracture/fringe.h"
#include "fracture/noise.h"

namespace windfall::fracture {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::uint32_t kBarkLevel = 63;  // apart from the levels of the wood

/// A sector of the cross-section, its outer part.
struct Sector {
    float angle, half_width, inner_radius;
    Sector(double angle_deg, double width_deg, double depth)
        : angle(static_cast<float>(angle_deg) * kPi / 180),
          half_width(static_cast<float>(width_deg) * kPi / 360),
          inner_radius(1 - static_cast<float>(depth)) {}
    bool holds(float radius, float at) const {
        if (half_width <= 0 || radius <= inner_radius) return false;
        return std::abs(std::remainder(at - angle, 2 * kPi)) <= half_width;
    }
};

/// atan2 in 0 .. 2 pi to 1e-5 without branches or library calls (Abramowitz & Stegun 4.4.49).
float angle_of(float x, float y) {
    const float ax = std::abs(x), ay = std::abs(y);
    const float large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const float q = small / (large + 1e-12F), q2 = q * q;
    float t =
        q * (0.9998660F + q2 * (-0.3302995F + q2 * (0.1801410F + q2 * (-0.0851330F + q2 * 0.0208351F))));
    t = ay > ax ? kPi / 2 - t : t;
    t = x < 0 ? kPi - t : t;
    t = y < 0 ? 2 * kPi - t : t;
    return t;
}

void place_centres(const PolarLattice& lattice, BreakWorkspace::Buffers& b) {
    const std::size_t sectors = static_cast<std::size_t>(lattice.sectors);
    std::vector<float> cosine(sectors), sine(sectors);
    for (std::size_t s = 0; s < sectors; ++s) {
        const float angle = 0.5F * (lattice.sector_angle[s] + lattice.sector_angle[s + 1]);
        cosine[s] = std::cos(angle);
        sine[s] = std::sin(angle);
    }
    b.centre_x.resize(lattice.cells());
    b.centre_y.resize(lattice.cells());
    for (int r = 0; r < lattice.rings; ++r) {
        const float radius = (static_cast<float>(r) + 0.5F) / static_cast<float>(lattice.rings);
        for (std::size_t s = 0; s < sectors; ++s) {
            b.centre_x[lattice.cell(r, 0) + s] = radius * cosine[s];
            b.centre_y[lattice.cell(r, 0) + s] = radius * sine[s];
        }
    }
}

/// Polar coordinates of the cells' centres in wood whose rays and rings wander.
void warp(const FractureParameters& parameters, BreakWorkspace::Buffers& b) {
    const std::uint32_t seed = noise_seed(parameters.seed);
    const std::uint32_t seed_x = noise_key(seed, NoisePurpose::WarpX, 0);
    const std::uint32_t seed_y = noise_key(seed, NoisePurpose::WarpY, 0);
    const auto frequency = static_cast<float>(parameters.bundles.warp_frequency);
    const auto amount = static_cast<float>(parameters.bundles.warp);
    const std::size_t count = b.centre_x.size();
    b.warped_radius.resize(count);
    b.warped_angle.resize(count);
    const float* __restrict x = b.centre_x.data();
    const float* __restrict y = b.centre_y.data();
    float* __restrict wx = b.warped_radius.data();
    float* __restrict wy = b.warped_angle.data();
    const auto two_octaves = [frequency](std::uint32_t key, float u, float v) {
        return gradient_noise(key, u * frequency, v * frequency) +
               0.4F * gradient_noise(key, 3.1F * u * frequency, 3.1F * v * frequency);
    };
    for (std::size_t i = 0; i < count; ++i) wx[i] = x[i] + amount * two_octaves(seed_x, x[i], y[i]);
    for (std::size_t i = 0; i < count; ++i) wy[i] = y[i] + amount * two_octaves(seed_y, x[i], y[i]);
    for (std::size_t i = 0; i < count; ++i) {
        const float u = wx[i], v = wy[i];
        wx[i] = std::sqrt(u * u + v * v);
        wy[i] = angle_of(u, v);
    }
}

/// Everything about the parameters that the cells ask for, in single precision.
class CellMaker {
  public:
    CellMaker(const FractureParameters& p, BreakWorkspace::Buffers& buffers)
        : m_p(p),
          m_b(buffers),
          m_seed(noise_seed(p.seed)),
          m_high(p.high.angle_deg, p.high.width_deg, p.high.depth),
          m_low(p.low.angle_deg, p.low.width_deg, p.low.depth),
          m_ductile(p.ductile.angle_deg, p.ductile.width_deg, p.ductile.depth),
          m_pith(static_cast<float>(p.tissue.pith)),
          m_heartwood(m_pith + static_cast<float>(p.tissue.heartwood)),
          m_sapwood(1 - static_cast<float>(p.tissue.phloem)),
          m_high_name(noise_key(m_seed, NoisePurpose::LayerName, 1)),
          m_low_name(noise_key(m_seed, NoisePurpose::LayerName, 2)),
          m_strips(bark_strips(p)),
          m_bundles(!p.bundles.radial.empty()) {
        const double slope = std::tan(p.fracture.tilt_deg * std::numbers::pi / 180);
        const double direction = p.fracture.tilt_direction_deg * std::numbers::pi / 180;
        m_tilt_x = static_cast<float>(slope * std::cos(direction));
        m_tilt_y = static_cast<float>(slope * std::sin(direction));
        m_thorns = {Thorns(p.thorns.pith_probability, p.thorns.pith_length),
                    Thorns(p.thorns.heartwood_probability, p.thorns.heartwood_length),
                    Thorns(p.thorns.sapwood_probability, p.thorns.sapwood_length),
                    Thorns(p.thorns.phloem_probability, p.thorns.phloem_length)};
        m_ductile_thorns = Thorns(p.ductile.probability, p.ductile.length);
    }

    void fill() {
        const PolarLattice& lattice = m_b.lattice;
        BreakCells& cells = m_b.cells;
        const std::size_t count = lattice.cells();
        cells.name.resize(count);
        cells.height.resize(count);
        cells.slope_x.resize(count);
        cells.slope_y.resize(count);
        cells.tissue.resize(count);
        m_b.finest_bundle.resize(count);
        cells.thorn.assign(count, 0.0F);
        cells.fibre.assign(count, -1);
        m_b.sites.clear();
        for (int r = 0; r < lattice.rings; ++r) {
            const float radius = (static_cast<float>(r) + 0.5F) / static_cast<float>(lattice.rings);
            const Tissue tissue = r == 0 ? Tissue::Pith : tissue_at(radius);
            for (int s = 0; s < lattice.sectors; ++s) fill_cell(r, s, radius, tissue);
        }
        share_the_pith();
        if (m_bundles)
            place_bundle_thorns();
        else
            place_cell_thorns();
        place_strands();
    }

  private:
    struct Thorns {
        float probability = 0, length = 0;
        Thorns() = default;
        Thorns(double p, double l) : probability(static_cast<float>(p)), length(static_cast<float>(l)) {}
    };

    Tissue tissue_at(float radius) const {
        if (radius <= m_pith) return Tissue::Pith;
        if (radius <= m_heartwood) return Tissue::Heartwood;
        return radius <= m_sapwood ? Tissue::Sapwood : Tissue::Phloem;
    }

    void fill_cell(int r, int s, float radius, Tissue tissue) {
        const std::size_t c = m_b.lattice.cell(r, s);
        const float angle = 0.5F * (m_b.lattice.sector_angle[static_cast<std::size_t>(s)] +
                                    m_b.lattice.sector_angle[static_cast<std::size_t>(s) + 1]);
        Plane plane{0, 0, 0, 0};
        if (m_high.holds(radius, angle)) {
            plane.height += static_cast<float>(m_p.high.height);
            plane.name ^= m_high_name;
        }
        if (m_low.holds(radius, angle)) {
            plane.height += static_cast<float>(m_p.low.height);
            plane.name ^= m_low_name;
        }
        if (!m_bundles) {
            plane.slope_x = m_tilt_x;
            plane.slope_y = m_tilt_y;
        } else if (tissue == Tissue::Phloem) {
            add_bark(m_b.warped_radius[c], m_b.warped_angle[c], plane);
        } else {
            add_bundles(c, plane);
        }
        if (tissue == Tissue::Phloem) lower_for_strips(angle, plane);
        m_b.cells.tissue[c] = tissue;
        m_b.cells.name[c] = plane.name;
        m_b.cells.height[c] = plane.height;
        m_b.cells.slope_x[c] = plane.slope_x;
        m_b.cells.slope_y[c] = plane.slope_y;
    }

    struct Plane {
        float height, slope_x, slope_y;
        std::uint32_t name;
    };

    /// Coarse planes are taken at the centre of the next finer bundle, so that they become terraces with
    /// walls along the grain.
    void add_bundles(std::size_t c, Plane& plane) {
        const float radius = m_b.warped_radius[c], angle = m_b.warped_angle[c];
        const auto flat = static_cast<float>(m_p.bundles.terraces);
        float slope_x = m_tilt_x, slope_y = m_tilt_y;
        for (BundleTable& table : m_b.tables) {
            const std::size_t index = table.index_at(radius, angle);
            const Bundle& bundle = table.bundle(index);
            m_b.finest_bundle[c] = static_cast<std::uint32_t>(index);
            plane.height += flat * (slope_x * bundle.centre_x + slope_y * bundle.centre_y) + bundle.height;
            slope_x = (1 - flat) * slope_x + bundle.slope_x;
            slope_y = (1 - flat) * slope_y + bundle.slope_y;
            plane.name ^= bundle.name;
        }
        plane.slope_x = slope_x;
        plane.slope_y = slope_y;
    }

    /// Bark tears in wide tongues along the coarse relief of the wood beneath it.
    void add_bark(float radius, float angle, Plane& plane) {
        const Bundle& tongue = m_b.bark_table.at(0.5F, angle);
        plane.height += static_cast<float>(m_p.bundles.bark_offset) +
                        (unit_float(tongue.name) - 0.5F) * static_cast<float>(m_p.bundles.bark_amplitude);
        plane.name ^= tongue.name ^ 0x5bd1e995U;
        plane.slope_x = m_tilt_x;
        plane.slope_y = m_tilt_y;
        float share = 1;
        for (std::size_t level = 0; level < std::min<std::size_t>(2, m_b.tables.size()); ++level) {
            const Bundle& bundle = m_b.tables[level].at(radius, angle);
            plane.height += share * bundle.height;
            plane.slope_x += share * bundle.slope_x;
            plane.slope_y += share * bundle.slope_y;
            plane.name ^= bundle.name;
            share = 0.5F;
        }
    }

    /// Where a strip of bark has peeled off, its wood stands bare.
    void lower_for_strips(float angle, Plane& plane) const {
        for (const BarkStrip& strip : m_strips)
            if (strip.holds(angle)) {
                plane.height -= strip.length;
                plane.name ^= strip.name;
            }
    }

    /// The innermost ring has one vertex at the pith, hence one plane.
    void share_the_pith() {
        BreakCells& cells = m_b.cells;
        for (std::size_t s = 1; s < static_cast<std::size_t>(m_b.lattice.sectors); ++s) {
            cells.name[s] = cells.name[0];
            cells.height[s] = cells.height[0];
            cells.slope_x[s] = cells.slope_x[0];
            cells.slope_y[s] = cells.slope_y[0];
        }
        const std::uint32_t pith = noise_key(m_seed, NoisePurpose::PithName, 0);
        for (std::size_t s = 0; m_bundles && s < static_cast<std::size_t>(m_b.lattice.sectors); ++s)
            cells.name[s] ^= pith;
    }

    const Thorns& thorns_at(float radius, float angle, Tissue tissue) const {
        return m_ductile_thorns.probability > 0 && m_ductile.holds(radius, angle)
                   ? m_ductile_thorns
                   : m_thorns[static_cast<std::size_t>(tissue)];
    }

    /// Length of the thorn of particle (i, j); 0: none, < 0: on the fallen piece.
    float drawn_length(const Thorns& thorns, std::uint32_t i, std::uint32_t j) const {
        if (thorns.probability <= 0 || thorns.length <= 0) return 0;
        const bool stub = random_unit(m_seed, NoisePurpose::ThornStub, i, j) < thorns.probability;
        const bool piece = !stub && random_unit(m_seed, NoisePurpose::ThornPiece, i, j) < thorns.probability;
        if (!stub && !piece) return 0;
        const float length = thorns.length * std::pow(random_unit(m_seed, NoisePurpose::ThornLength, i, j),
                                                      static_cast<float>(m_p.thorns.skew));
        return stub ? length : -length;
    }

    bool may_stand(int ring) const { return ring >= 1 && ring + 1 < m_b.lattice.rings; }

    void start_site(float length, bool strand, std::uint32_t bits, int ring, int sector) {
        const std::size_t c = m_b.lattice.cell(ring, sector);
        ThornSite site;
        site.length = length;
        site.strand = strand;
        site.shape = bits;
        site.centre_x = m_b.centre_x[c];
        site.centre_y = m_b.centre_y[c];
        site.ring = ring;
        site.sector = sector;
        give_cell(c, static_cast<std::int32_t>(m_b.sites.size()), length);
        m_b.sites.push_back(site);
    }

    void give_cell(std::size_t c, std::int32_t site, float length) {
        m_b.cells.thorn[c] = length;
        m_b.cells.fibre[c] = site;
    }

    /// The paper's thorns: each particle on its own.
    void place_cell_thorns() {
        if (!any_thorns()) return;
        const PolarLattice& lattice = m_b.lattice;
        for (int r = 1; may_stand(r); ++r)
            for (int s = 0; s < lattice.sectors; ++s) {
                const std::size_t c = lattice.cell(r, s);
                const float radius = (static_cast<float>(r) + 0.5F) / static_cast<float>(lattice.rings);
                const float angle = 0.5F * (lattice.sector_angle[static_cast<std::size_t>(s)] +
                                            lattice.sector_angle[static_cast<std::size_t>(s) + 1]);
                const auto i = static_cast<std::uint32_t>(r), j = static_cast<std::uint32_t>(s);
                const float length = drawn_length(thorns_at(radius, angle, m_b.cells.tissue[c]), i, j);
                if (length == 0) continue;
                const std::uint32_t bits = noise_key(m_seed, NoisePurpose::ThornShape, i, j);
                m_b.cells.name[c] ^= bits | 1U;
                start_site(length, false, bits, r, s);
            }
    }

    bool any_thorns() const {
        float most = m_ductile_thorns.probability;
        for (const Thorns& t : m_thorns) most = std::max(most, t.probability);
        return most > 0;
    }

    /// Where there are bundles, each of the finest ones is a particle: it stands out whole.
    void place_bundle_thorns() {
        if (!any_thorns()) return;
        const PolarLattice& lattice = m_b.lattice;
        BundleTable& finest = m_b.tables.back();
        m_b.site_of_bundle.assign(finest.size(), kUnseen);
        for (int r = 1; may_stand(r); ++r)
            for (int s = 0; s < lattice.sectors; ++s) {
                const std::size_t c = lattice.cell(r, s);
                if (m_b.cells.tissue[c] == Tissue::Phloem) continue;
                const std::uint32_t index = m_b.finest_bundle[c];
                std::int32_t& site = m_b.site_of_bundle[index];
                if (site == kUnseen) site = draw_bundle_site(finest.bundle(index), r, s);
                if (site >= 0) join_site(static_cast<std::size_t>(site), c, r, s);
            }
    }

    std::int32_t draw_bundle_site(const Bundle& bundle, int r, int s) {
        const float radius = std::sqrt(bundle.centre_x * bundle.centre_x + bundle.centre_y * bundle.centre_y);
        const float angle = angle_of(bundle.centre_x, bundle.centre_y);
        const Tissue tissue = std::min(tissue_at(radius), Tissue::Sapwood);
        const float length = drawn_length(thorns_at(radius, angle, tissue), bundle.name, 0);
        if (length == 0) return kNoSite;
        const auto index = static_cast<std::int32_t>(m_b.sites.size());
        start_site(length, false, bundle.name, r, s);
        ThornSite& site = m_b.sites.back();
        site.centre_x = bundle.centre_x;
        site.centre_y = bundle.centre_y;
        site.name = m_b.cells.name[m_b.lattice.cell(r, s)];
        site.distance = std::numeric_limits<float>::max();
        return index;
    }

    /// A finest bundle may be cut by the border of a coarse one; only the part with the first cell stands
    /// out.
    void join_site(std::size_t index, std::size_t c, int r, int s) {
        ThornSite& site = m_b.sites[index];
        if (m_b.cells.name[c] != site.name) return;
        m_b.cells.name[c] ^= mixed_bits(site.shape) | 1U;
        give_cell(c, static_cast<std::int32_t>(index), site.length);
        const float dx = m_b.centre_x[c] - site.centre_x, dy = m_b.centre_y[c] - site.centre_y;
        const float distance = dx * dx + dy * dy;
        if (distance >= site.distance) return;
        site.distance = distance;
        site.ring = r;
        site.sector = s;
    }

    /// Single torn fibres: one cell each, wherever the cell is free.
    void place_strands() {
        const PolarLattice& lattice = m_b.lattice;
        const TensionField tension = tension_field(m_p);
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(m_p.fringe.strands); ++k) {
            const auto random = [&](std::uint32_t j) {
                return random_unit(m_seed, NoisePurpose::Strand, k, j);
            };
            const float radius = std::sqrt(random(0)) * m_sapwood, angle = 2 * kPi * random(1);
            if (random(2) > tension.weight(radius * std::cos(angle), radius * std::sin(angle))) continue;
            const int r = static_cast<int>(radius * static_cast<float>(lattice.rings));
            const int s = std::min(lattice.sectors - 1,
                                   static_cast<int>(angle / (2 * kPi) * static_cast<float>(lattice.sectors)));
            const std::size_t c = lattice.cell(r, s);
            if (!may_stand(r) || m_b.cells.fibre[c] >= 0) continue;
            const float u = random(3);
            const float length = static_cast<float>(m_p.fringe.strand_length) * (0.15F + 0.85F * u * u);
            const std::uint32_t bits = noise_key(m_seed, NoisePurpose::StrandShape, k);
            m_b.cells.name[c] ^= bits | 1U;
            start_site(random(4) < 0.5F ? length : -length, true, bits, r, s);
        }
    }

    static constexpr std::int32_t kUnseen = -2, kNoSite = -1;

    const FractureParameters& m_p;
    BreakWorkspace::Buffers& m_b;
    std::uint32_t m_seed;
    Sector m_high, m_low, m_ductile;
    float m_pith, m_heartwood, m_sapwood;
    std::uint32_t m_high_name, m_low_name;
    std::vector<BarkStrip> m_strips;
    bool m_bundles;
    float m_tilt_x = 0, m_tilt_y = 0;
    std::array<Thorns, 4> m_thorns{};
    Thorns m_ductile_thorns{};
};

}  // namespace

void fill_cells(const FractureParameters& parameters, BreakWorkspace::Buffers& buffers) {
    const BundleParameters& b = parameters.bundles;
    const std::uint32_t seed = noise_seed(parameters.seed);
    const TensionField tension = tension_field(parameters);
    place_centres(buffers.lattice, buffers);
    if (!b.radial.empty()) {
        warp(parameters, buffers);
        buffers.tables.resize(b.radial.size());
        for (std::size_t level = 0; level < b.radial.size(); ++level)
            buffers.tables[level].reset(
                seed, static_cast<std::uint32_t>(level),
                {static_cast<float>(b.radial[level]), static_cast<float>(b.angular[level]),
                 static_cast<float>(b.amplitude[level]), static_cast<float>(b.slope[level]),
                 static_cast<float>(b.skew)},
                tension);
        buffers.bark_table.reset(seed, kBarkLevel, {2.0F, 0.15F, 0, 0, 1}, tension);
    }
    CellMaker(parameters, buffers).fill();
}

}  // namespace windfall::fracture
