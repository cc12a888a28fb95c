#include "decay/growth_state.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/parallel.h"
#include "decay/growth_noise.h"

namespace windfall::decay {

namespace {

constexpr std::size_t kRunsPerStep = 2;  // runs of tiles of one task
/// A front must not run past its neighbour within a step: its mobility is that of the step's start.
/// The speed below is that of fresh skin; fronts keep below 0.4 texels.
constexpr double kFrontTexelsPerStep = 0.45;
/// Nutrient is slow, and spread this often only: each time, the thin gain and loss far from a colony falls
/// below the last digit of the nutrient there, and the sum of all mass drifts by about 4e-10.
constexpr double kNutrientStep_h = 0.999;

/// Speed in m/h of a front where the damping factor is 1 and the nutrient is not yet eaten. The degenerate
/// forms have a sharp front of speed sqrt(D0 mu / 2) where B grows to 1 (J. D. Murray, Mathematical Biology
/// I, 2002, section 13.4).
double front_speed(const Organism& organism, double mean_nutrient) {
    const double rate = organism.motility_m2_h * organism.growth_per_h;
    if (organism.form == MotilityForm::Linear) return 2 * std::sqrt(rate);
    return std::sqrt(0.5 * rate * std::min(1.0, organism.crowding)) * mean_nutrient;
}

struct Header {
    std::uint64_t magic = 0x77666772'6f773031;  // "wfgrow01"
    std::uint64_t texels = 0, organisms = 0, seed = 0, steps = 0, passes = 0;
    double time_h = 0, nutrient_due_h = 0;
};

}  // namespace

Growth::State::State(const geometry::CubeAtlas& atlas, std::span<const geometry::Vec3> texel_positions_m,
                     const std::vector<Organism>& chosen, const GrowthSettings& chosen_settings,
                     std::uint64_t chosen_seed, const GrowthFields& fields)
    : settings(chosen_settings),
      seed(chosen_seed),
      positions(texel_positions_m.begin(), texel_positions_m.end()),
      stencil(make_stencil(atlas, positions)),
      tiles(stencil),
      diffusion(stencil, tiles),
      nutrient(atlas.side(), 8),
      gate(atlas.side(), 9),
      moisture(atlas.side(), 10) {
    for (const Organism& organism : chosen) {
        if (organism.species.kind == OrganismKind::SoftRot) soft_rot = organisms.size();
        organisms.push_back({organism, TexelField(atlas.side(), 7), TexelField(atlas.side(), 11),
                             TexelField(atlas.side(), 5), std::vector<std::uint8_t>(tiles.count(), 0),
                             std::vector<float>(tiles.count(), 0)});
    }
    set_fields(atlas, fields);
}

void Growth::State::set_fields(const geometry::CubeAtlas& atlas, const GrowthFields& fields) {
    // Value noise rarely comes near its ends: stretched, its spread is about that of a uniform one.
    constexpr float kStretch = 1.6F, kLeastFactor = 0.25F;
    const auto noise = [&](GrowthNoise purpose, std::size_t o, double length_m, double amplitude,
                           std::size_t texel) {
        const float value = value_noise(noise_stream(seed, purpose, o), positions[texel] / length_m);
        return std::max(kLeastFactor, 1 + kStretch * static_cast<float>(amplitude) * value);
    };
    const auto runs = atlas.runs();
    parallel_for_each(runs.size(), [&](std::size_t r) {
        for (std::size_t i = runs[r].begin; i < runs[r].end; ++i) {
            nutrient[i] =
                static_cast<float>(settings.nutrient_level) *
                (fields.nutrient.empty() ? 1 : std::max(fields.nutrient[i], 0.0F)) *
                noise(GrowthNoise::Nutrient, 0, settings.nutrient_noise_m, settings.nutrient_noise, i);
            moisture[i] = fields.wetness.empty() ? 0 : std::clamp(fields.wetness[i], 0.0F, 1.0F);
            for (std::size_t o = 0; o < organisms.size(); ++o)
                organisms[o].motility_factor[i] =
                    noise(GrowthNoise::Motility, o, settings.motility_noise_m, settings.motility_noise, i);
        }
    });
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        sum += static_cast<double>(nutrient[i]) * stencil.area_m2[i];
        area += stencil.area_m2[i];
    }
    mean_nutrient = sum / area;
}

double Growth::State::longest_step_h(const GrowthConditions& conditions) const {
    double longest_h = settings.longest_step_h;
    for (const Life& life : organisms) {
        float links = 0;
        for (std::size_t tile = 0; tile < tiles.count(); ++tile)
            if (life.alive[tile] != 0) links = std::max(links, diffusion.largest_link_sum()[tile]);
        const StepRates rates = step_rates(life.organism, conditions, 1);
        const double speed =
            std::max(rates.damping_skin, rates.damping_inside) * front_speed(life.organism, mean_nutrient);
        // Of square texels of side h, the sum of links over area is 4 / h^2.
        if (links > 0 && speed > 0)
            longest_h = std::min(longest_h, kFrontTexelsPerStep * 2 / (std::sqrt(links) * speed));
    }
    return longest_h;
}

std::vector<std::uint32_t> Growth::State::working_tiles(const Life& life) const {
    if (std::find(life.alive.begin(), life.alive.end(), 1) == life.alive.end()) return {};
    // Only a degenerate mobility keeps the front from running ahead of its tile within a step.
    return life.organism.form == MotilityForm::Linear ? tiles.covered() : tiles.with_surroundings(life.alive);
}

void Growth::State::set_mobility(Life& life, std::size_t o, const StepRates& rates, double step_h,
                                 const std::vector<std::uint32_t>& working) {
    const Organism& organism = life.organism;
    const auto half = static_cast<float>(0.5 * step_h * organism.motility_m2_h);
    const float inverse_capacity =
        organism.form == MotilityForm::Logistic ? static_cast<float>(1 / organism.capacity) : 0;
    const bool linear = organism.form == MotilityForm::Linear;
    const float constant = linear ? 1 : 0, degenerate = 1 - constant;
    const auto swing = static_cast<float>(2 * settings.step_noise);
    const std::uint32_t key = noise_stream(seed, GrowthNoise::Step, steps, o);
    std::fill(life.largest_mobility.begin(), life.largest_mobility.end(), 0.0F);
    const auto runs = tiles.runs(working);
    parallel_blocks(runs.size(), kRunsPerStep, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            tiles.for_pieces(runs[k], [&](std::uint32_t tile, std::size_t begin, std::size_t end) {
                float* __restrict mobility = diffusion.half_mobility().data();
                if (life.alive[tile] == 0 && !linear) {
                    std::fill(mobility + begin, mobility + end, 0.0F);
                    return;
                }
                const float* __restrict u = life.active.data(), * __restrict n = nutrient.data();
                const float* __restrict wet = moisture.data(), * __restrict factor =
                                                                   life.motility_factor.data();
                // Floats that are not negative are ordered as their bits are, and whole numbers may be
                // compared in any order, eight at a time.
                std::int32_t largest_bits = 0;
                for (std::size_t i = begin; i < end; ++i) {
                    const float delta =
                        swing * (unit_interval(scrambled(static_cast<std::uint32_t>(i) ^ key)) - 0.5F);
                    const float room = 1 - u[i] * inverse_capacity;
                    const float crowd = constant + degenerate * u[i] * std::max(room, 0.0F) * n[i];
                    const float value = half * damping_at(rates, wet[i]) * factor[i] * (1 + delta) * crowd;
                    mobility[i] = value;
                    largest_bits = std::max(largest_bits, std::bit_cast<std::int32_t>(value));
                }
                float& largest = life.largest_mobility[tile];
                largest = std::max(largest, std::bit_cast<float>(largest_bits));
            });
        }
    });
}

void Growth::State::react_all(std::span<const StepRates> rates,
                              const std::vector<std::vector<std::uint32_t>>& working) {
    std::vector<std::uint8_t> at_work(tiles.count(), 0);  // one bit an organism
    for (std::size_t o = 0; o < organisms.size(); ++o)
        for (const std::uint32_t tile : working[o]) at_work[tile] |= static_cast<std::uint8_t>(1U << o);
    std::vector<std::uint32_t> all;
    for (std::size_t tile = 0; tile < at_work.size(); ++tile) {
        if (at_work[tile] == 0) continue;
        all.push_back(static_cast<std::uint32_t>(tile));
        for (Life& life : organisms) life.alive[tile] = 0;
    }
    const auto runs = tiles.runs(all);
    parallel_blocks(runs.size(), kRunsPerStep, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            tiles.for_pieces(runs[k], [&](std::uint32_t tile, std::size_t begin, std::size_t end) {
                std::array<OrganismRun, kMostOrganisms> pieces;
                std::array<std::uint8_t*, kMostOrganisms> alive{};
                std::size_t count = 0;
                for (std::size_t o = 0; o < organisms.size(); ++o) {
                    if ((at_work[tile] >> o & 1U) == 0) continue;
                    Life& life = organisms[o];
                    alive[count] = &life.alive[tile];
                    pieces[count++] = {&rates[o], life.active.data() + begin, life.inactive.data() + begin,
                                       false};
                }
                react({pieces.data(), count}, nutrient.data() + begin, moisture.data() + begin, end - begin);
                for (std::size_t r = 0; r < count; ++r)
                    if (pieces[r].alive) *alive[r] = 1;
            });
        }
    });
}

void Growth::State::step(double step_h, const GrowthConditions& conditions) {
    std::array<StepRates, kMostOrganisms> rates;
    std::vector<std::vector<std::uint32_t>> working(organisms.size());
    for (std::size_t o = 0; o < organisms.size(); ++o) {
        Life& life = organisms[o];
        rates[o] = step_rates(life.organism, conditions, step_h);
        working[o] = working_tiles(life);
        if (working[o].empty()) continue;
        diffusion.clear_all_but(working[o]);
        set_mobility(life, o, rates[o], step_h, working[o]);
        const bool is_fungus = life.organism.species.kind == OrganismKind::Fungus;
        passes += static_cast<std::uint64_t>(
            diffusion.spread(life.active, working[o], life.largest_mobility, is_fungus ? &gate : nullptr));
    }
    nutrient_due_h += step_h;
    if (nutrient_due_h >= kNutrientStep_h) {
        diffusion.spread_evenly(nutrient, settings.nutrient_motility_m2_h * nutrient_due_h);
        nutrient_due_h = 0;
    }
    react_all(rates, working);
    open_gate();
    ++steps;
    time_h += step_h;
}

void Growth::State::open_gate() {
    const Life& rot = organisms[soft_rot];
    const auto ramp = [](double from, double to) {
        return [low = static_cast<float>(from), slope = static_cast<float>(1 / (to - from))](float x) {
            const float share = (x - low) * slope;
            return share < 1 ? share : 1;
        };
    };
    const auto open_at = ramp(settings.gate_closed, settings.gate_open);
    const auto wet_at = ramp(settings.sap_begins, settings.sap_full);
    std::vector<std::uint32_t> rotten_tiles;
    for (const std::uint32_t tile : tiles.covered())
        if (rot.alive[tile] != 0) rotten_tiles.push_back(tile);
    const auto runs = tiles.runs(rotten_tiles);
    parallel_blocks(runs.size(), kRunsPerStep, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            tiles.for_pieces(runs[k], [&](std::uint32_t, std::size_t begin, std::size_t end) {
                const float *u = rot.active.data(), *v = rot.inactive.data();
                float *g = gate.data(), *wet = moisture.data();
                for (std::size_t i = begin; i < end; ++i) {
                    const float rotten = u[i] + v[i];
                    const float open = open_at(rotten), soaked = wet_at(rotten);
                    g[i] = open > g[i] ? open : g[i];
                    wet[i] = soaked > wet[i] ? soaked : wet[i];
                }
            });
        }
    });
}

double Growth::State::active_share() const {
    std::size_t count = 0;
    for (const std::uint32_t tile : tiles.covered())
        count += std::any_of(organisms.begin(), organisms.end(),
                             [&](const Life& life) { return life.alive[tile] != 0; })
                     ? 1
                     : 0;
    return static_cast<double>(count) / static_cast<double>(tiles.covered().size());
}

std::vector<TexelField*> Growth::State::saved_fields() {
    std::vector<TexelField*> fields{&nutrient, &gate, &moisture};
    for (Life& life : organisms) {
        fields.push_back(&life.active);
        fields.push_back(&life.inactive);
    }
    return fields;
}

std::vector<std::byte> Growth::State::save() const {
    std::vector<const TexelField*> fields{&nutrient, &gate, &moisture};
    for (const Life& life : organisms) {
        fields.push_back(&life.active);
        fields.push_back(&life.inactive);
    }
    Header header;
    header.texels = positions.size();
    header.organisms = organisms.size();
    header.seed = seed;
    header.steps = steps;
    header.passes = passes;
    header.time_h = time_h;
    header.nutrient_due_h = nutrient_due_h;
    const std::size_t field_bytes = positions.size() * sizeof(float);
    std::vector<std::byte> bytes(sizeof(Header) + fields.size() * field_bytes);
    std::memcpy(bytes.data(), &header, sizeof(Header));
    std::byte* at = bytes.data() + sizeof(Header);
    for (const TexelField* field : fields) {
        std::memcpy(at, field->data(), field_bytes);
        at += field_bytes;
    }
    return bytes;
}

void Growth::State::restore(std::span<const std::byte> bytes) {
    const std::vector<TexelField*> fields = saved_fields();
    const std::size_t field_bytes = positions.size() * sizeof(float);
    Header header;
    const Header expected;
    if (bytes.size() == sizeof(Header) + fields.size() * field_bytes)
        std::memcpy(&header, bytes.data(), sizeof(Header));
    if (header.magic != expected.magic || header.texels != positions.size() ||
        header.organisms != organisms.size() || header.seed != seed)
        throw InputError(
            "the saved growth is not of this fruit: start again, or use the recipe, texture size and seed "
            "that it "
            "was saved with");
    const std::byte* at = bytes.data() + sizeof(Header);
    for (TexelField* field : fields) {
        std::memcpy(field->data(), at, field_bytes);
        at += field_bytes;
    }
    steps = header.steps;
    passes = header.passes;
    time_h = header.time_h;
    nutrient_due_h = header.nutrient_due_h;
    for (Life& life : organisms) {
        std::fill(life.alive.begin(), life.alive.end(), 0);
        for (std::size_t i = 0; i < positions.size(); ++i)
            if (life.active[i] > 0) life.alive[tiles.tile_of(i)] = 1;
    }
}

}  // namespace windfall::decay
