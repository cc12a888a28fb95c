#include "decay/mold_hair.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.h"
#include "core/error.h"
#include "core/parallel.h"
#include "decay/growth_noise.h"
#include "decay/shading_maps_texel.h"
#include "take/map_lookup.h"

namespace windfall::decay {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kMostStrands = 200'000;
constexpr std::size_t kStrandsABlock = 2048;
constexpr int kMoldPoints = 3, kWhiskerPoints = 5, kHeadPoints = 2;
/// Random numbers of a strand.
constexpr std::uint32_t kHairPurpose = 201;

/// The random numbers of one strand, one after the other.
class StrandNumbers {
  public:
    StrandNumbers(std::uint32_t key, std::size_t number)
        : m_bits(scrambled(key ^ scrambled(static_cast<std::uint32_t>(number)))) {}
    float next() {
        m_bits = scrambled(m_bits + 0x9E3779B9U);
        return unit_interval(m_bits);
    }

  private:
    std::uint32_t m_bits;
};

std::uint32_t hair_key(std::uint64_t seed) {
    return noise_stream(seed, static_cast<GrowthNoise>(kHairPurpose));
}

double face_area(const take::TakeMesh& mesh, std::size_t face) {
    const auto at = [&](std::size_t k) {
        return mesh.rest.positions[static_cast<std::size_t>(mesh.rest.faces[face][k])];
    };
    const double first = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    if (geometry::corner_count(mesh.rest.faces[face]) == 3) return first;
    return first + (at(2) - at(0)).cross(at(3) - at(0)).norm() / 2;
}

/// Unit normals at the vertices.
std::vector<Vector3f> moved_normals(const take::TakeMesh& mesh, const std::vector<Vector3f>& positions) {
    std::vector<Vector3f> normals(positions.size(), Vector3f::Zero());
    for (const auto& face : mesh.rest.faces) {
        const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(face[k])]; };
        const std::size_t corners = geometry::corner_count(face) == 3 ? 3 : 4;
        const Vector3f area = (at(2) - at(0)).cross(at(corners - 1) - at(1));
        for (std::size_t k = 0; k < corners; ++k) normals[static_cast<std::size_t>(face[k])] += area;
    }
    for (Vector3f& normal : normals) {
        const float length = normal.norm();
        normal = length > 0 ? Vector3f(normal / length) : Vector3f::UnitY();
    }
    return normals;
}

/// The kinds of hair, each a set of curves of its own.
constexpr std::size_t kMoldHair = 0, kWhiskers = 1, kHeads = 2, kHairKinds = 3;

/// What mold there is at a root: that of the species which covers most.
struct MoldThere {
    const MoldLook* look = nullptr;
    float cover = 0, active = 0;
};

MoldThere mold_at(const RawMaps& raw, const Vector2f& uv) {
    MoldThere there;
    for (const RawMaps::Fungus& fungus : raw.fungi) {
        if (fungus.look.hair.radius_m <= 0) continue;
        const float density = take::map_value(*fungus.density, uv.x(), uv.y());
        const float cover = mold_cover(density, 0, 0);
        if (cover <= there.cover) continue;
        there = {&fungus.look, cover,
                 fungus.active != nullptr ? take::map_value(*fungus.active, uv.x(), uv.y()) : 0};
    }
    return there;
}

/// A strand that stands: where, which way, and of what.
struct Strand {
    Vector3f root, up, sideways;
    std::int32_t number, face;
    Vector2f place;
};

void append_strand(take::FrameCurves& curves, const Strand& strand, float radius,
                   const LinearColour& colour) {
    curves.radii.push_back(radius);
    curves.colours.push_back(colour);
    curves.numbers.push_back(strand.number);
    curves.faces.push_back(strand.face);
    curves.face_places.push_back(strand.place);
}

/// A strand that rises along `up` and bends over sideways by `bend` of its length.
void append_bent(take::FrameCurves& curves, const Strand& strand, float length, float bend, float radius,
                 const LinearColour& colour) {
    // a bent strand of the same length rises less: root mean square of sqrt(1 + (2 bend t)^2) along it
    const float height = length / std::sqrt(1 + 4 * bend * bend / 3);
    for (int k = 0; k < curves.points_per_strand; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(curves.points_per_strand - 1);
        curves.points.emplace_back(strand.root + height * (t * strand.up + bend * t * t * strand.sideways));
    }
    append_strand(curves, strand, radius, colour);
}

void grow_strand(std::array<take::FrameCurves, kHairKinds>& hair, const Strand& strand, const MoldThere& mold,
                 StrandNumbers& numbers, float units_a_metre) {
    const HairLook& look = mold.look->hair;
    const float threshold = 0.05F + 0.75F * numbers.next();  // of the cover from which on this strand stands
    const float kind = numbers.next(), size = numbers.next(), shade = numbers.next();
    const float grown = smooth_rise(threshold, threshold + 0.2F, mold.cover);
    if (grown <= 0) return;
    const float age = mold_age(mold.active, 2 * shade - 1);
    LinearColour colour = blended(mold.look->young, mold.look->mature, age) * (0.88F + 0.24F * shade);
    colour = colour.cwiseMin(1.0F);
    const float radius = look.radius_m * units_a_metre;
    if (kind < look.whisker_share) {
        // whiskers come up behind the rim, once the mat has food to give
        const float length =
            look.whisker_length_m * (0.33F + 0.67F * size) * grown * smooth_rise(0.15F, 0.8F, age);
        if (length <= 0) return;
        const float bend = 0.9F * look.lean * (shade - 0.3F);
        append_bent(hair[kWhiskers], strand, length * units_a_metre, bend, 1.3F * radius,
                    blended(mold.look->young, mold.look->mature, 0.4F * age));
        if (look.sporangium_radius_m <= 0 || age < 0.45F) return;
        const float head = look.sporangium_radius_m * smooth_rise(0.45F, 0.75F, age) * (0.7F + 0.6F * shade);
        const Vector3f tip = hair[kWhiskers].points.back();
        hair[kHeads].points.insert(hair[kHeads].points.end(),
                                   {tip, tip + 0.3F * head * units_a_metre * strand.up});
        append_strand(hair[kHeads], strand, head * units_a_metre,
                      blended(LinearColour(0.30F, 0.29F, 0.27F), LinearColour(0.02F, 0.02F, 0.022F), age));
        return;
    }
    const float mean_m = look.young_length_m + age * (look.length_m - look.young_length_m);
    append_bent(hair[kMoldHair], strand, mean_m * (0.5F + size) * grown * units_a_metre,
                look.lean * (shade - 0.4F), radius, colour);
}

void append_all(take::FrameCurves& to, const take::FrameCurves& from) {
    const auto add = [](auto& target, const auto& source) {
        target.insert(target.end(), source.begin(), source.end());
    };
    add(to.points, from.points);
    add(to.radii, from.radii);
    add(to.colours, from.colours);
    add(to.numbers, from.numbers);
    add(to.faces, from.faces);
    add(to.face_places, from.face_places);
}

void reserve(take::FrameCurves& curves, std::size_t strands) {
    curves.points.reserve(strands * static_cast<std::size_t>(curves.points_per_strand));
    curves.radii.reserve(strands);
    curves.colours.reserve(strands);
    curves.numbers.reserve(strands);
    curves.faces.reserve(strands);
    curves.face_places.reserve(strands);
}

std::array<take::FrameCurves, kHairKinds> empty_hair(const std::string& mesh) {
    std::array<take::FrameCurves, kHairKinds> hair;
    constexpr std::array<const char*, kHairKinds> kNames{"mold", "whiskers", "sporangia"};
    constexpr std::array<int, kHairKinds> kPoints{kMoldPoints, kWhiskerPoints, kHeadPoints};
    for (std::size_t kind = 0; kind < kHairKinds; ++kind) {
        hair[kind].name = kNames[kind];
        hair[kind].mesh = mesh;
        hair[kind].points_per_strand = kPoints[kind];
    }
    return hair;
}

}  // namespace

MoldHair::MoldHair(const take::TakeMesh& mesh, double unit_length_m, const MoldHairSettings& settings)
    : m_mesh(mesh), m_unit_length_m(unit_length_m), m_settings(settings) {
    if (settings.strands < 1 || settings.strands > kMostStrands)
        throw InputError(
            fmt::format("{} strands of mold cannot be; give 1 to {}", settings.strands, kMostStrands));
    if (mesh.rest.corner_uvs.size() != mesh.rest.faces.size())
        throw InputError(
            fmt::format("mesh '{}' has no texture coordinates, so mold cannot be found on it", mesh.name));
    std::vector<double> until(mesh.rest.faces.size());  // area of the faces up to and with this one
    double area = 0;
    for (std::size_t f = 0; f < until.size(); ++f) until[f] = area += face_area(mesh, f);
    if (!(area > 0)) throw InputError(fmt::format("mesh '{}' has no area for mold to stand on", mesh.name));

    const std::uint32_t key = hair_key(settings.seed) + 1;
    m_roots.resize(static_cast<std::size_t>(settings.strands));
    parallel_blocks(m_roots.size(), kStrandsABlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            StrandNumbers numbers(key, i);
            // One strand to each of equal shares of the area: even, and neighbours in number are so on the
            // skin.
            const double target = area * (static_cast<double>(i) + numbers.next()) / settings.strands;
            const auto found = std::upper_bound(until.begin(), until.end(), target);
            const auto f = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
                found - until.begin(), static_cast<std::ptrdiff_t>(until.size()) - 1));
            const auto& face = mesh.rest.faces[f];
            Vector2f place(numbers.next(), numbers.next());
            if (geometry::corner_count(face) == 3 && place.sum() > 1) place = Vector2f::Ones() - place;
            const auto weights = take::face_weights(face, place.x(), place.y());
            Vector2f uv = Vector2f::Zero();
            for (std::size_t k = 0; k < 4; ++k) uv += weights[k] * mesh.rest.corner_uvs[f][k].cast<float>();
            m_roots[i] = {static_cast<std::int32_t>(f), place, uv};
        }
    });
}

std::vector<take::FrameCurves> MoldHair::grow(const RawMaps& raw, const take::FrameMesh& moved) const {
    if (moved.positions.size() != m_mesh.rest.positions.size())
        throw InputError(fmt::format("mesh '{}' has {} vertices in the frame and {} in the take", m_mesh.name,
                                     moved.positions.size(), m_mesh.rest.positions.size()));
    const std::vector<Vector3f> normals = moved_normals(m_mesh, moved.positions);
    const std::uint32_t key = hair_key(m_settings.seed);
    const auto units_a_metre = static_cast<float>(1 / m_unit_length_m);
    const std::size_t blocks = (m_roots.size() + kStrandsABlock - 1) / kStrandsABlock;
    std::vector<std::array<take::FrameCurves, kHairKinds>> grown(blocks);
    parallel_for_each(blocks, [&](std::size_t block) {
        grown[block] = empty_hair(m_mesh.name);
        reserve(grown[block][kMoldHair], kStrandsABlock);
        const std::size_t end = std::min(m_roots.size(), (block + 1) * kStrandsABlock);
        for (std::size_t i = block * kStrandsABlock; i < end; ++i) {
            const Root& root = m_roots[i];
            const MoldThere mold = mold_at(raw, root.uv);
            if (mold.look == nullptr) continue;
            const auto& face = m_mesh.rest.faces[static_cast<std::size_t>(root.face)];
            const auto weights = take::face_weights(face, root.place.x(), root.place.y());
            Strand strand{Vector3f::Zero(), Vector3f::Zero(), {}, static_cast<std::int32_t>(i),
                          root.face,        root.place};
            for (std::size_t k = 0; k < static_cast<std::size_t>(geometry::corner_count(face)); ++k) {
                strand.root += weights[k] * moved.positions[static_cast<std::size_t>(face[k])];
                strand.up += weights[k] * normals[static_cast<std::size_t>(face[k])];
            }
            StrandNumbers numbers(key, i);
            const float angle = kTwoPi<float> * numbers.next(), lean = mold.look->hair.lean * numbers.next();
            const Vector3f normal = strand.up.normalized();
            const Vector3f x = normal.unitOrthogonal(), y = normal.cross(x);
            strand.sideways = std::cos(angle) * x + std::sin(angle) * y;
            strand.up = (normal + lean * strand.sideways).normalized();
            grow_strand(grown[block], strand, mold, numbers, units_a_metre);
        }
    });
    auto hair = empty_hair(m_mesh.name);
    for (std::size_t kind = 0; kind < kHairKinds; ++kind) {
        std::size_t strands = 0;
        for (const auto& part : grown) strands += part[kind].strand_count();
        reserve(hair[kind], strands);
        for (const auto& part : grown) append_all(hair[kind], part[kind]);
    }
    std::vector<take::FrameCurves> result;
    for (auto& curves : hair)
        if (curves.strand_count() > 0) result.push_back(std::move(curves));
    return result;
}

}  // namespace windfall::decay
