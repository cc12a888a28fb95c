#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "core/parallel.h"
#include "decay/mold_hair.h"
#include "support/message_of.h"
#include "support/rotten_fruit.h"

namespace windfall::decay {
namespace {

using testing::HasSubstr;

constexpr int kStrands = 20'000;

std::vector<take::FrameCurves> hair_of(const take::Frame& frame, const std::string& species = "digitatum",
                                       std::uint64_t seed = 5, int strands = kStrands) {
    RotLook look;
    look.species = species;
    const MoldHair hair(rotten_ball(), 1, {strands, seed});
    return hair.grow(RawMaps(frame, "skin", look), frame.meshes[0]);
}

const take::FrameCurves* named(const std::vector<take::FrameCurves>& hair, const std::string& name) {
    for (const auto& curves : hair)
        if (curves.name == name) return &curves;
    return nullptr;
}

const Eigen::Vector3f& root(const take::FrameCurves& curves, std::size_t strand) {
    return curves.points[strand * static_cast<std::size_t>(curves.points_per_strand)];
}

float length(const take::FrameCurves& curves, std::size_t strand) {
    const auto n = static_cast<std::size_t>(curves.points_per_strand);
    float sum = 0;
    for (std::size_t k = 1; k < n; ++k)
        sum += (curves.points[strand * n + k] - curves.points[strand * n + k - 1]).norm();
    return sum;
}

TEST(MoldHair, StandsWhereMoldIsAndOutwards) {
    EXPECT_TRUE(hair_of(rotten_frame(0, 0.02, 0)).empty());
    const auto hair = hair_of(rotten_frame(0, 0.028, 0.018));
    const take::FrameCurves* mold = named(hair, "mold");
    ASSERT_NE(mold, nullptr);
    // the colony is a cap of 18 mm: its share of the ball, less the thin edge
    const double share = (1 - std::cos(0.018 / kBallRadius_m)) / 2;
    const auto count = static_cast<double>(mold->strand_count());
    EXPECT_GT(count, 0.7 * share * kStrands);
    EXPECT_LT(count, 1.02 * share * kStrands);
    for (std::size_t i = 0; i < mold->strand_count(); ++i) {
        const Eigen::Vector3f& at = root(*mold, i);
        EXPECT_LT(distance_to_colony_m(at.cast<double>()), 0.018 + 1e-3);
        EXPECT_GT(at.norm(), 0.97 * kBallRadius_m);
        const Eigen::Vector3f tip = mold->points[3 * i + 2];
        EXPECT_GT((tip - at).dot(at), 0);
        if (i > 0) {
            EXPECT_GT(mold->numbers[i], mold->numbers[i - 1]);
        }
    }
}

TEST(MoldHair, RootsLieWhereTheirFacesSay) {
    const auto hair = hair_of(rotten_frame(0, 0.028, 0.018));
    const take::TakeMesh mesh = rotten_ball();
    const take::FrameCurves& mold = *named(hair, "mold");
    for (std::size_t i = 0; i < mold.strand_count(); i += 7) {
        const auto& face = mesh.rest.faces[static_cast<std::size_t>(mold.faces[i])];
        const auto weights = take::face_weights(face, mold.face_places[i].x(), mold.face_places[i].y());
        geometry::Vec3 place = geometry::Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            place += weights[k] * mesh.rest.positions[static_cast<std::size_t>(face[k])];
        EXPECT_LT((place.cast<float>() - root(mold, i)).norm(), 1e-6F);
    }
}

TEST(MoldHair, AStrandIsTheSameOneInLaterFramesAndGrows) {
    const auto before = hair_of(rotten_frame(0, 0.024, 0.014), "rhizopus");
    const auto after = hair_of(rotten_frame(1, 0.028, 0.018), "rhizopus");
    for (const char* name : {"mold", "whiskers"}) {
        const take::FrameCurves *first = named(before, name), *second = named(after, name);
        ASSERT_NE(first, nullptr) << name;
        ASSERT_NE(second, nullptr) << name;
        std::map<std::int32_t, std::size_t> later;
        for (std::size_t i = 0; i < second->strand_count(); ++i) later[second->numbers[i]] = i;
        EXPECT_GT(later.size(), first->strand_count());
        for (std::size_t i = 0; i < first->strand_count(); ++i) {
            const auto found = later.find(first->numbers[i]);
            ASSERT_NE(found, later.end()) << name << " " << first->numbers[i];
            EXPECT_EQ(root(*first, i), root(*second, found->second));
            EXPECT_GE(length(*second, found->second), 0.999F * length(*first, i));
        }
    }
}

TEST(MoldHair, IsAsLongAsTheSpeciesHasIt) {
    const take::Frame frame = rotten_frame(0, 0.03, 0.024);
    const auto longest = [](const take::FrameCurves* curves) {
        float most = 0;
        for (std::size_t i = 0; curves != nullptr && i < curves->strand_count(); ++i)
            most = std::max(most, length(*curves, i));
        return most;
    };
    const auto velvet = hair_of(frame, "digitatum"), whiskers = hair_of(frame, "rhizopus");
    EXPECT_LT(longest(named(velvet, "mold")), 1e-3F);
    EXPECT_GT(longest(named(velvet, "mold")), 2e-4F);
    EXPECT_EQ(named(velvet, "whiskers"), nullptr);
    EXPECT_GT(longest(named(whiskers, "whiskers")), 7e-3F);
    EXPECT_LT(longest(named(whiskers, "whiskers")), 17e-3F);
    const take::FrameCurves* heads = named(whiskers, "sporangia");
    ASSERT_NE(heads, nullptr);
    float darkest = 1;
    for (const auto& colour : heads->colours) darkest = std::min(darkest, colour.maxCoeff());
    EXPECT_LT(darkest, 0.1F);
    EXPECT_TRUE(hair_of(frame, "erwinia").empty());
}

TEST(MoldHair, MovesWithTheSkin) {
    take::Frame frame = rotten_frame(0, 0.028, 0.018);
    const auto still = hair_of(frame);
    const Eigen::Vector3f shift(0.01F, -0.02F, 0.005F);
    for (auto& p : frame.meshes[0].positions) p += shift;
    const auto moved = hair_of(frame);
    ASSERT_EQ(still[0].points.size(), moved[0].points.size());
    for (std::size_t i = 0; i < still[0].points.size(); ++i)
        EXPECT_LT((moved[0].points[i] - still[0].points[i] - shift).norm(), 1e-6F);
}

TEST(MoldHair, IsTheSameBitsOnAnyNumberOfThreadsAndAnotherWithAnotherSeed) {
    const take::Frame frame = rotten_frame(0, 0.028, 0.018);
    std::vector<take::FrameCurves> one;
    {
        const ThreadLimit limit(1);
        one = hair_of(frame);
    }
    const auto many = hair_of(frame), other = hair_of(frame, "digitatum", 6);
    EXPECT_EQ(one[0].points, many[0].points);
    EXPECT_EQ(one[0].colours, many[0].colours);
    EXPECT_NE(one[0].points, other[0].points);
}

TEST(MoldHair, RefusesWhatCannotBe) {
    EXPECT_THAT(message_of([] { MoldHair(rotten_ball(), 1, {200'001, 1}); }), HasSubstr("200001"));
    EXPECT_THROW(MoldHair(rotten_ball(), 1, {0, 1}), InputError);
    take::TakeMesh bare = rotten_ball();
    bare.rest.corner_uvs.clear();
    EXPECT_THROW(MoldHair(bare, 1, {100, 1}), InputError);
    take::Frame frame = rotten_frame(0, 0.02, 0.01);
    frame.meshes[0].positions.pop_back();
    EXPECT_THROW(hair_of(frame), InputError);
}

}  // namespace
}  // namespace windfall::decay
