#include <gtest/gtest.h>

#include <set>

#include "decay/species.h"
#include "support/message_of.h"

namespace windfall::decay {
namespace {

TEST(CardinalGrowth, IsOneAtTheBestAndZeroOutside) {
    const CardinalValues t{3, 24.5, 36};
    EXPECT_DOUBLE_EQ(cardinal_growth(t, 24.5), 1);
    for (const double x : {-10.0, 3.0, 36.0, 40.0}) EXPECT_EQ(cardinal_growth(t, x), 0) << x;
    double before = 0;
    for (double x = 3.5; x <= 24.5; x += 0.5) {
        const double growth = cardinal_growth(t, x);
        EXPECT_GT(growth, before);
        EXPECT_LE(growth, 1);
        before = growth;
    }
    for (double x = 25; x < 36; x += 0.5) {
        EXPECT_LT(cardinal_growth(t, x), before);
        before = cardinal_growth(t, x);
    }
    // Rosso 1993 for these values: (14-36)(14-3)^2 / (21.5 (21.5 (14-24.5) - (24.5-36)(24.5+3-28)))
    EXPECT_NEAR(cardinal_growth(t, 14), -2662 / (21.5 * (-225.75 - 5.75)), 1e-12);
}

TEST(RotSpecies, ColdSlowsHeatAndDroughtStopGreenMould) {
    const Species& mould = species_named("penicillium-digitatum");
    EXPECT_GT(cardinal_growth(mould.temperature_c, 4), 0);
    EXPECT_LT(cardinal_growth(mould.temperature_c, 4), 0.1 * cardinal_growth(mould.temperature_c, 22));
    EXPECT_EQ(cardinal_growth(mould.temperature_c, 40), 0);
    EXPECT_EQ(cardinal_growth(mould.water_activity, 0.5), 0);
    EXPECT_GT(cardinal_growth(mould.water_activity, 1), 0);
}

TEST(RotSpecies, AreWholeAndHaveSources) {
    std::set<std::string> names;
    for (const Species& one : species()) {
        names.insert(one.name);
        EXPECT_FALSE(one.source.empty()) << one.name;
        for (const CardinalValues& v : {one.temperature_c, one.water_activity}) {
            EXPECT_LT(v.minimum, v.optimum) << one.name;
            EXPECT_LT(v.optimum, v.maximum) << one.name;
            // Rosso's curve has its top at the optimum only where that lies above the middle.
            EXPECT_GT(2 * v.optimum, v.minimum + v.maximum) << one.name;
        }
    }
    EXPECT_EQ(names.size(), species().size());
    for (const char* name :
         {"penicillium-expansum", "penicillium-digitatum", "rhizopus", "neofabraea", "erwinia"})
        EXPECT_EQ(names.count(name), 1U) << name;
    EXPECT_EQ(species_named("erwinia").kind, OrganismKind::SoftRot);
    EXPECT_NE(message_of([] { species_named("erwina"); }).find("'erwinia'"), std::string::npos);
}

}  // namespace
}  // namespace windfall::decay
