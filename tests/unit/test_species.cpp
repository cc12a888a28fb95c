#include "fracture/species.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace windfall::fracture {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

FractureParameters of_species(SpeciesName name) {
    FractureParameters p;
    p.species.name = name;
    return p;
}

TEST(Species, HeightLawGivesTheFourMeasuredWoods) {
    const auto law = [](SpeciesName name) { return height_law(measured_wood(name)->properties); };
    EXPECT_NEAR(law(SpeciesName::Juniperus), 6.683, 0.002);
    EXPECT_NEAR(law(SpeciesName::JuniperusChinensis), 3.024, 0.002);
    EXPECT_NEAR(law(SpeciesName::Ailanthus), 0.745, 0.002);
    EXPECT_NEAR(law(SpeciesName::Koelreuteria), 0.561, 0.002);
    for (const MeasuredWood& wood : measured_woods())
        EXPECT_NEAR(height_law(wood.properties), wood.measured_height, 0.002) << wood.botanical_name;
}

TEST(Species, MeasuredWoodsGiveTheirHeightWithoutAWarning) {
    for (const MeasuredWood& wood : measured_woods()) {
        std::vector<std::string> warnings;
        EXPECT_EQ(asked_mean_height(of_species(wood.name), &warnings), height_law(wood.properties));
        EXPECT_TRUE(warnings.empty()) << warnings.front();
    }
}

TEST(Species, NumbersOfTheRecipeCountForACustomWoodAlone) {
    FractureParameters p = of_species(SpeciesName::Custom);
    p.species.density_g_cm3 = 0.70;
    p.species.shrinkage_tangential = 0.09;
    EXPECT_EQ(wood_properties(p.species).density_g_cm3, 0.70);
    EXPECT_EQ(wood_properties(p.species).shrinkage_tangential, 0.09);
    p.species.name = SpeciesName::Ailanthus;
    EXPECT_EQ(wood_properties(p.species).density_g_cm3, 0.67);
    EXPECT_EQ(wood_properties(p.species).shrinkage_tangential, 0.049);
}

TEST(Species, WoodBetweenTheMeasuredOnesNeedsNoWarning) {
    FractureParameters p = of_species(SpeciesName::Custom);
    const auto &a = measured_woods()[1].properties, &b = measured_woods()[2].properties;
    p.species.density_g_cm3 = 0.5 * (a.density_g_cm3 + b.density_g_cm3);
    p.species.bending_strength_mpa = 0.5 * (a.bending_strength_mpa + b.bending_strength_mpa);
    p.species.bending_modulus_gpa = 0.5 * (a.bending_modulus_gpa + b.bending_modulus_gpa);
    p.species.splitting_strength_kgf_cm = 0.5 * (a.splitting_strength_kgf_cm + b.splitting_strength_kgf_cm);
    std::vector<std::string> warnings;
    EXPECT_NEAR(asked_mean_height(p, &warnings), 0.5 * (3.024 + 0.745), 0.002);
    EXPECT_TRUE(warnings.empty());
}

TEST(Species, OakLiesOutsideTheMeasurementsAndIsHeldAboveZero) {
    FractureParameters p = of_species(SpeciesName::Custom);
    p.species.density_g_cm3 = 0.69;
    p.species.bending_strength_mpa = 100;
    p.species.bending_modulus_gpa = 12;
    p.species.splitting_strength_kgf_cm = 20;
    ASSERT_LT(height_law(wood_properties(p.species)), 0);
    std::vector<std::string> warnings;
    EXPECT_EQ(asked_mean_height(p, &warnings), kLeastHeight);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("species.bending_strength_mpa = 100 MPa (measured: 49 .. 97.8)"));
    EXPECT_THAT(warnings[0], HasSubstr("in place of -"));
    EXPECT_THAT(warnings[0], HasSubstr("break.height_from = asked and break.mean_height"));
    EXPECT_THAT(warnings[0], Not(HasSubstr("density")));
    EXPECT_EQ(asked_mean_height(p, nullptr), kLeastHeight);
}

TEST(Species, PropertiesWithinTheirRangesMayStillGiveAHeightOutside) {
    FractureParameters p = of_species(SpeciesName::Custom);
    p.species.density_g_cm3 = 0.78;
    p.species.bending_strength_mpa = 49;
    p.species.bending_modulus_gpa = 4.6;
    p.species.splitting_strength_kgf_cm = 6.7;
    std::vector<std::string> warnings;
    EXPECT_NEAR(asked_mean_height(p, &warnings), 17.1, 0.1);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("a height of 17.12 radii (measured: 0.56 .. 6.68)"));
}

TEST(Species, WetWoodBreaksInLongerFibresAndHasFewerCracks) {
    FractureParameters p = of_species(SpeciesName::Juniperus);
    const double dry = asked_mean_height(p, nullptr);
    p.species.moisture = Moisture::Wet;
    const MoistureEffect wet = moisture_effect(Moisture::Wet);
    EXPECT_GT(asked_mean_height(p, nullptr), dry);
    EXPECT_DOUBLE_EQ(asked_mean_height(p, nullptr), wet.fibre_length * dry);
    EXPECT_LT(wet.crack_count, 1);
    EXPECT_LT(wet.crack_width, 1);
    EXPECT_LT(wet.crack_depth, 1);
}

}  // namespace
}  // namespace windfall::fracture
