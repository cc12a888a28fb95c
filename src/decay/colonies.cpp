#include "decay/colonies.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "decay/growth_noise.h"

namespace windfall::decay {

namespace {

constexpr double kDay_hours = 24;
constexpr float kOpenGate = 1;

bool is_fungus(const Growth& growth, std::size_t organism) {
    return growth.organism(organism).species.kind == OrganismKind::Fungus;
}

/// Bytes in the order in which they are written and read.
class ByteWriter {
  public:
    template <class Value>
    void put(const Value& value) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(Value));
        std::memcpy(bytes.data() + at, &value, sizeof(Value));
    }
    std::vector<std::byte> bytes;
};

class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : m_left(bytes) {}
    template <class Value>
    Value get() {
        if (m_left.size() < sizeof(Value)) throw InputError("the saved colonies are cut short: start again");
        Value value;
        std::memcpy(&value, m_left.data(), sizeof(Value));
        m_left = m_left.subspan(sizeof(Value));
        return value;
    }
    bool at_end() const { return m_left.empty(); }

  private:
    std::span<const std::byte> m_left;
};

}  // namespace

Colonies::Colonies(const ColonySettings& settings, std::uint64_t seed) : m_settings(settings), m_seed(seed) {
    if (!(settings.propagation >= 0 && settings.propagation <= 9))
        throw InputError(fmt::format("the propagation must be 0 to 9, not {:g}", settings.propagation));
    if (!(settings.reach_m > 0 && settings.seed_radius_m > 0))
        throw InputError(
            fmt::format("seeds must reach and spread some way: reach {:g} m, radius {:g} m must be > 0",
                        settings.reach_m, settings.seed_radius_m));
}

void Colonies::start(Growth& growth, const StartingPoint& point) {
    m_waiting.push_back(
        {point.organism, growth.nearest_texel(point.point_m), point.radius_m, point.strength});
    plant_waiting(growth);
}

void Colonies::plant_waiting(Growth& growth) {
    std::vector<Waiting> still;
    for (const Waiting& seed : m_waiting) {
        if (is_fungus(growth, seed.organism) && growth.gate()[seed.texel] < kOpenGate) {
            still.push_back(seed);
            continue;
        }
        growth.plant(seed.organism, seed.texel, seed.radius_m, seed.density);
        m_colonies.push_back({seed.organism, seed.texel, growth.time_h()});
    }
    m_waiting = std::move(still);
}

void Colonies::spread(Growth& growth) {
    plant_waiting(growth);
    const auto today = static_cast<std::uint64_t>(growth.time_h() / kDay_hours);
    for (; m_day < today; ++m_day) {
        for (const bool fungi : {false, true})
            for (std::size_t o = 0; o < growth.organism_count(); ++o)
                if (is_fungus(growth, o) == fungi) spread_day(growth, o);
    }
}

void Colonies::spread_day(Growth& growth, std::size_t organism) {
    const double chance = 1 / (10 - m_settings.propagation);
    const std::size_t parents = m_colonies.size();
    for (std::size_t c = 0; c < parents && m_colonies.size() < m_settings.most; ++c) {
        if (m_colonies[c].organism != organism) continue;
        if (unit_interval(noise_stream(m_seed, GrowthNoise::Spread, m_day, c)) >= chance) continue;
        const auto reach = growth.disc(m_colonies[c].texel, m_settings.reach_m);
        double area = 0;
        for (const std::size_t i : reach) area += growth.areas_m2()[i];
        double left = area * unit_interval(noise_stream(m_seed, GrowthNoise::SpreadPlace, m_day, c));
        std::size_t texel = reach.back();
        for (const std::size_t i : reach) {
            left -= growth.areas_m2()[i];
            if (left < 0) {
                texel = i;
                break;
            }
        }
        const double own = growth.active(organism)[texel] + growth.inactive(organism)[texel];
        if (own > m_settings.crowded_density || growth.nutrient()[texel] < m_settings.poor_nutrient) continue;
        if (is_fungus(growth, organism) && growth.gate()[texel] < kOpenGate) continue;
        growth.plant(organism, texel, m_settings.seed_radius_m, m_settings.seed_density);
        m_colonies.push_back({organism, texel, growth.time_h()});
    }
}

std::vector<std::byte> Colonies::save() const {
    ByteWriter writer;
    writer.put(m_seed);
    writer.put(m_day);
    writer.put(m_colonies.size());
    for (const Colony& colony : m_colonies) writer.put(colony);
    writer.put(m_waiting.size());
    for (const Waiting& waiting : m_waiting) writer.put(waiting);
    return std::move(writer.bytes);
}

void Colonies::restore(std::span<const std::byte> state) {
    ByteReader reader(state);
    if (reader.get<std::uint64_t>() != m_seed)
        throw InputError("the saved colonies have another seed: use the seed that they were saved with");
    const auto day = reader.get<std::uint64_t>();
    std::vector<Colony> colonies;
    for (auto count = reader.get<std::size_t>(); count > 0; --count) colonies.push_back(reader.get<Colony>());
    std::vector<Waiting> waiting;
    for (auto count = reader.get<std::size_t>(); count > 0; --count) waiting.push_back(reader.get<Waiting>());
    if (!reader.at_end()) throw InputError("the saved colonies are too long: start again");
    m_day = day;
    m_colonies = std::move(colonies);
    m_waiting = std::move(waiting);
}

}  // namespace windfall::decay
