#include "drying/skin_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "core/random.h"
#include "support/small_body.h"

namespace windfall::drying {
namespace {

using geometry::Vec3;

FourPoints random_points(std::uint64_t seed) {
    FourPoints points;
    for (std::size_t p = 0; p < 4; ++p) {
        const auto r = random_uniform4(seed, RandomPurpose::LanczosStart, p);
        points[p] = Vec3(r[0], r[1], r[2]);
    }
    return points;
}

TEST(ContactGap, KnownDistances) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    const auto to_triangle = [&](const Vec3& p) {
        return contact_gap(ContactKind::VertexTriangle, {p, a, b, c});
    };
    EXPECT_NEAR(to_triangle({0.2, 0.3, 0.7}).distance, 0.7, 1e-15);
    EXPECT_NEAR(to_triangle({0.2, 0.3, -0.7}).normal.z(), -1, 1e-15);
    EXPECT_NEAR(to_triangle({-3, 0, 4}).distance, 5, 1e-14);
    EXPECT_NEAR(to_triangle({1, 1, 0}).distance, std::sqrt(0.5), 1e-14);
    const auto of_edges = [&](const Vec3& p, const Vec3& q) {
        return contact_gap(ContactKind::EdgeEdge, {a, b, p, q});
    };
    EXPECT_NEAR(of_edges({0.5, -1, 0.4}, {0.5, 1, 0.4}).distance, 0.4, 1e-15);
    EXPECT_NEAR(of_edges({0, 0, 2}, {1, 0, 2}).distance, 2, 1e-15);
    EXPECT_NEAR(of_edges({4, 4, 0}, {4, 9, 0}).distance, 5, 1e-14);
    EXPECT_EQ(of_edges({0.5, -1, 0}, {0.5, 1, 0}).distance, 0);
}

TEST(ContactGap, GradientIsThatOfFiniteDifferences) {
    constexpr double kStep = 1e-6;
    for (const ContactKind kind : {ContactKind::VertexTriangle, ContactKind::EdgeEdge})
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            const FourPoints points = random_points(seed);
            const ContactGap gap = contact_gap(kind, points);
            for (std::size_t p = 0; p < 4; ++p)
                for (int i = 0; i < 3; ++i) {
                    FourPoints ahead = points, behind = points;
                    ahead[p][i] += kStep;
                    behind[p][i] -= kStep;
                    const double slope =
                        (contact_gap(kind, ahead).distance - contact_gap(kind, behind).distance) /
                        (2 * kStep);
                    EXPECT_NEAR(gap.weights[p] * gap.normal[i], slope, 1e-4);
                }
        }
}

TEST(ContactGap, MollifierVanishesWhereEdgesAreParallel) {
    const FourPoints parallel = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(2, 0, 1)};
    EXPECT_EQ(edge_mollifier(parallel, 1).value, 0);
    const FourPoints crossed = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 1)};
    EXPECT_EQ(edge_mollifier(crossed, 1).value, 1);
    FourPoints nearly = parallel;
    nearly[3] += Vec3(0.01, 0.015, -0.02);
    const Mollifier mollifier = edge_mollifier(nearly, 1);
    EXPECT_GT(mollifier.value, 0.1);
    EXPECT_LT(mollifier.value, 0.9);
    constexpr double kStep = 1e-7;
    for (std::size_t p = 0; p < 4; ++p)
        for (int i = 0; i < 3; ++i) {
            FourPoints ahead = nearly, behind = nearly;
            ahead[p][i] += kStep;
            behind[p][i] -= kStep;
            const double slope =
                (edge_mollifier(ahead, 1).value - edge_mollifier(behind, 1).value) / (2 * kStep);
            EXPECT_NEAR(mollifier.gradient[p][i], slope, 1e-5 * (1 + std::abs(slope)));
        }
}

TEST(ContactGap, WayEndsBeforeTheTouch) {
    const FourPoints above = {Vec3(0.2, 0.2, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const auto moved = [](double z) {
        return FourPoints{Vec3(0, 0, z), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    };
    EXPECT_EQ(free_part_of_way(ContactKind::VertexTriangle, above, moved(-0.5), 1), 1);
    EXPECT_EQ(free_part_of_way(ContactKind::VertexTriangle, above, moved(10), 1), 1);
    const double part = free_part_of_way(ContactKind::VertexTriangle, above, moved(-10), 1);
    EXPECT_GT(part, 0.08);
    EXPECT_LT(part, 0.1);
    // Past the triangle, not through it.
    FourPoints aside = above;
    aside[0] = Vec3(0.7, 0.7, 1);
    EXPECT_EQ(free_part_of_way(ContactKind::VertexTriangle, aside, moved(-10), 1), 1);
    const FourPoints edges = {Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(0, -1, 0), Vec3(0, 1, 0)};
    const FourPoints down = {Vec3(0, 0, -4), Vec3(0, 0, -4), Vec3::Zero(), Vec3::Zero()};
    const double of_edges = free_part_of_way(ContactKind::EdgeEdge, edges, down, 1);
    EXPECT_GT(of_edges, 0.2);
    EXPECT_LT(of_edges, 0.25);
    // Moving together is free, however far.
    const FourPoints together = {Vec3(9, 9, -9), Vec3(9, 9, -9), Vec3(9, 9, -9), Vec3(9, 9, -9)};
    EXPECT_EQ(free_part_of_way(ContactKind::EdgeEdge, edges, together, 1), 1);
}

/// A sphere whose poles along z are pressed flat against each other.
struct Pinched {
    geometry::LayeredMesh mesh = test::small_sphere(8, 8);
    Multigrid multigrid{mesh.brick, 8, kernels(8)};
    SkinContact contact{mesh, multigrid.order(), 1, 3};

    /// Both sheets `height` from the middle, a negative one: past each other.
    AlignedArray<double> pressed(double height) const {
        AlignedArray<double> u(multigrid.vector_size());
        for (std::int32_t c = 0; c < multigrid.order().column_count(); ++c) {
            const Vec3& x = fresh(c);
            const double radius = std::hypot(x.x(), x.y());
            const double t = std::clamp((radius - 0.5) / 0.4, 0.0, 1.0);
            const double flat = height * std::copysign(1.0, x.z());
            u[place(c, 2)] = (1 - t * t * (3 - 2 * t)) * (flat - x.z());
        }
        return u;
    }
    const Vec3& fresh(std::int32_t c) const {
        return mesh.node(static_cast<std::size_t>(multigrid.order().vertex_of_solver[c]), mesh.layers);
    }
    static std::size_t place(std::int32_t c, std::size_t axis) {
        return (static_cast<std::size_t>(c) * 3 + axis) * 8 + 7;
    }
};

TEST(SkinContact, NothingPressesOnAFreshSkin) {
    Pinched body;
    AlignedArray<double> force(body.multigrid.vector_size());
    const AlignedArray<double> rest(body.multigrid.vector_size());
    const ContactEnergy energy = body.contact.energy(rest, &force);
    EXPECT_EQ(energy.energy, 0);
    EXPECT_EQ(energy.pairs, 0);
    for (const double f : force) ASSERT_EQ(f, 0);
}

TEST(SkinContact, ForceIsTheGradientOfTheEnergy) {
    Pinched body;
    AlignedArray<double> u = body.pressed(0.3 * body.contact.gap());
    const AlignedArray<double> noise = test::random_displacement(u.size(), 0.03 * body.contact.gap(), 3);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += noise[i];
    AlignedArray<double> force(u.size());
    ASSERT_GT(body.contact.energy(u, &force).pairs, 50);
    constexpr double kStep = 1e-7;
    for (std::uint64_t seed = 10; seed < 16; ++seed) {
        const AlignedArray<double> way = test::random_displacement(u.size(), 1, seed);
        AlignedArray<double> ahead = u, behind = u;
        double expected = 0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            ahead[i] += kStep * way[i];
            behind[i] -= kStep * way[i];
            expected += force[i] * way[i];
        }
        const double slope =
            (body.contact.energy(ahead, nullptr).energy - body.contact.energy(behind, nullptr).energy) /
            (2 * kStep);
        EXPECT_NEAR(slope, expected, 1e-5 * (std::abs(expected) + 1));
    }
}

TEST(SkinContact, FlatSheetsPressWithTheWorkOfComingCloser) {
    Pinched body;
    const double height = 0.25 * body.contact.gap();
    AlignedArray<double> force(body.multigrid.vector_size());
    body.contact.energy(body.pressed(height), &force);
    double upper = 0;
    double lower = 0;
    for (std::int32_t c = 0; c < body.multigrid.order().column_count(); ++c)
        (body.fresh(c).z() > 0 ? upper : lower) += force[Pinched::place(c, 2)];
    EXPECT_LT(upper, 0) << "energy must fall when the upper sheet rises";
    EXPECT_NEAR(upper, -lower, 1e-9 * std::abs(upper)) << "reaction equals action";
    // Half the gap: the pressure is about the stiffness, over the flat part of the sheets.
    const double flat_area = 3.14 * 0.5 * 0.5;
    EXPECT_GT(-upper, 0.5 * 3 * flat_area);
    EXPECT_LT(-upper, 2 * 3 * flat_area);
}

TEST(SkinContact, TangentOfFlatSheetsIsTheSecondDerivative) {
    Pinched body;
    const double height = 0.3 * body.contact.gap();
    const AlignedArray<double> u = body.pressed(height);
    AlignedArray<float> way(u.size()), image(u.size());
    AlignedArray<double> ahead = u, behind = u;
    constexpr double kStep = 1e-5;
    for (std::int32_t c = 0; c < body.multigrid.order().column_count(); ++c) {
        const Vec3& x = body.fresh(c);
        if (std::hypot(x.x(), x.y()) > 0.5 || x.z() < 0) continue;
        way[Pinched::place(c, 2)] = 1;
        ahead[Pinched::place(c, 2)] += kStep;
        behind[Pinched::place(c, 2)] -= kStep;
    }
    const auto energy = [&](const AlignedArray<double>& at) {
        return body.contact.energy(at, nullptr).energy;
    };
    const double expected = (energy(ahead) - 2 * energy(u) + energy(behind)) / (kStep * kStep);
    body.contact.linearize(u);
    body.multigrid.set_matrix_zero();
    body.contact.add_to_diagonal(body.multigrid.matrix());
    double told = body.multigrid.product(way.data(), image.data());
    told += body.contact.add_product(way.data(), image.data());
    double product = 0;
    for (std::size_t i = 0; i < u.size(); ++i) product += static_cast<double>(way[i]) * image[i];
    EXPECT_NEAR(told, product, 1e-5 * product);
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(product, expected, 0.05 * expected);
}

TEST(SkinContact, TangentIsSymmetricAndPositive) {
    Pinched body;
    body.contact.linearize(body.pressed(0.2 * body.contact.gap()));
    body.multigrid.set_matrix_zero();
    body.contact.add_to_diagonal(body.multigrid.matrix());
    const auto image_of = [&](const AlignedArray<float>& x) {
        AlignedArray<float> y(x.size());
        body.multigrid.product(x.data(), y.data());
        body.contact.add_product(x.data(), y.data());
        return y;
    };
    const auto random_floats = [&](std::uint64_t seed) {
        const AlignedArray<double> values = test::random_displacement(body.multigrid.vector_size(), 1, seed);
        AlignedArray<float> result(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) result[i] = static_cast<float>(values[i]);
        return result;
    };
    const auto dot = [](const AlignedArray<float>& a, const AlignedArray<float>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
        return sum;
    };
    for (std::uint64_t seed = 1; seed < 9; seed += 2) {
        const AlignedArray<float> a = random_floats(seed), b = random_floats(seed + 1);
        const double aa = dot(a, image_of(a));
        EXPECT_GT(aa, 0);
        EXPECT_NEAR(dot(a, image_of(b)), dot(b, image_of(a)), 1e-5 * aa);
    }
}

TEST(SkinContact, StepsEndBeforeSheetsPassThroughEachOther) {
    Pinched body;
    const AlignedArray<double> from = body.pressed(0.8 * body.contact.gap());
    AlignedArray<double> to = body.pressed(-0.8 * body.contact.gap());
    const double part = body.contact.free_part(from, to);
    EXPECT_GT(part, 0.4);
    EXPECT_LT(part, 0.5);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + part * (to[i] - from[i]);
    const ContactEnergy energy = body.contact.energy(to, nullptr);
    EXPECT_GT(energy.pairs, 0);
    EXPECT_GT(energy.smallest_distance, 0);
    EXPECT_TRUE(std::isfinite(energy.energy));
    EXPECT_EQ(body.contact.free_part(from, body.pressed(0.1)), 1);
}

TEST(SkinContact, SameBitsWhateverWasLookedAtBeforeAndOnAnyThreads) {
    Pinched fresh;
    const AlignedArray<double> u = fresh.pressed(0.2 * fresh.contact.gap());
    AlignedArray<double> expected(u.size());
    fresh.contact.energy(u, &expected);
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        Pinched used;
        used.contact.free_part(used.pressed(0.6), used.pressed(0.3));
        used.contact.energy(used.pressed(0.4 * used.contact.gap()), nullptr);
        AlignedArray<double> force(u.size());
        used.contact.energy(u, &force);
        EXPECT_EQ(std::memcmp(force.data(), expected.data(), u.size() * sizeof(double)), 0);
    }
}

}  // namespace
}  // namespace windfall::drying
