#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"
#include "water/ledger.h"
#include "water/transpiration.h"
#include "water/vapour_pressure.h"

namespace windfall::water {
namespace {

TEST(VapourPressure, AgreesWithTheTables) {
    // Smithsonian Meteorological Tables: 6.11, 23.37, 1013.2 hPa
    EXPECT_NEAR(saturation_pressure_pa(0), 611, 0.001 * 611);
    EXPECT_NEAR(saturation_pressure_pa(20), 2337, 0.001 * 2337);
    EXPECT_NEAR(saturation_pressure_pa(100), 101320, 0.001 * 101320);
    EXPECT_DOUBLE_EQ(vapour_pressure_pa(20, 0.5), 0.5 * saturation_pressure_pa(20));
}

TEST(Transpiration, ATomatoLosesAboutAGramADay) {
    const double grams = 1000 * 86400 *
                         transpiration_kg_per_s({.coefficient_ug_s_m2_pa = 0.9,
                                                 .area_m2 = ball_area_m2(0.123),
                                                 .surface_c = 22,
                                                 .air_c = 22,
                                                 .relative_humidity = 0.5});
    EXPECT_GE(grams, 0.7);
    EXPECT_LE(grams, 1.5);
}

TEST(Transpiration, NothingIsLostIntoDampAir) {
    Transpiration skin{.coefficient_ug_s_m2_pa = 1, .area_m2 = 0.01, .relative_humidity = 0.99};
    EXPECT_EQ(transpiration_kg_per_s(skin), 0);
    skin.relative_humidity = 0.97;
    EXPECT_GT(transpiration_kg_per_s(skin), 0);
}

TEST(Transpiration, TheAreaOfABall) {
    const double radius = 0.03;
    const double mass = 1000 * 4 * M_PI / 3 * std::pow(radius, 3);
    EXPECT_NEAR(ball_area_m2(mass), 4 * M_PI * radius * radius, 1e-12);
}

TEST(WaterLedger, ClosesOverManySmallLosses) {
    WaterLedger ledger(0.123, 0.115);
    double taken = 0;
    for (int k = 0; k < 100000; ++k) taken += ledger.take(1.37e-7 * (1 + 0.3 * std::sin(k)));
    EXPECT_GT(ledger.lost_fraction(), 0.1);
    EXPECT_LE(std::abs(ledger.error()), 1e-9);
    EXPECT_DOUBLE_EQ(taken, ledger.lost_kg());
}

TEST(WaterLedger, NeverGivesMoreThanThereIs) {
    WaterLedger ledger(0.1, 0.08);
    EXPECT_DOUBLE_EQ(ledger.take(0.05), 0.05);
    EXPECT_NEAR(ledger.take(0.05), 0.03, 1e-15);
    EXPECT_EQ(ledger.take(0.05), 0);
    EXPECT_EQ(ledger.water_left_kg(), 0);
    EXPECT_NEAR(ledger.mass_kg(), 0.02, 1e-15);
    EXPECT_EQ(ledger.take(-1), 0);
    EXPECT_LE(std::abs(ledger.error()), 1e-15);
}

TEST(WaterLedger, RefusesMassWithoutWaterAndWaterWithoutMass) {
    EXPECT_THROW(WaterLedger(0.1, 0), InputError);
    EXPECT_THROW(WaterLedger(0.1, 0.11), InputError);
    EXPECT_THROW(WaterLedger(0, 0), InputError);
    EXPECT_THROW(WaterLedger(0.1, NAN), InputError);
    WaterLedger ledger(0.1, 0.08);
    EXPECT_NE(message_of([&] { ledger.restore(0.05, 0.04); }), "no error");
    ledger.restore(0.05, 0.03);
    EXPECT_EQ(ledger.lost_kg(), 0.05);
}

}  // namespace
}  // namespace windfall::water
