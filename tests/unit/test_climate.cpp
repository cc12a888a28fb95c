#include "water/climate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/message_of.h"

namespace windfall::water {
namespace {

TEST(Climate, IsLinearBetweenRowsAndRepeatsEveryDay) {
    const Climate climate({{6, 10, 0.8}, {18, 30, 0.2}});
    EXPECT_DOUBLE_EQ(climate.at(6).temperature_c, 10);
    EXPECT_DOUBLE_EQ(climate.at(12).temperature_c, 20);
    EXPECT_DOUBLE_EQ(climate.at(12).relative_humidity, 0.5);
    EXPECT_DOUBLE_EQ(climate.at(0).temperature_c, 20);
    EXPECT_DOUBLE_EQ(climate.at(3).temperature_c, 15);
    EXPECT_DOUBLE_EQ(climate.at(21).temperature_c, 25);
    EXPECT_NEAR(climate.at(24 * 20 + 9).temperature_c, 15, 1e-12);
}

TEST(Climate, OneRowIsAlwaysTheSame) {
    const Climate climate = constant_climate(22, 0.5);
    for (const double hour : {0.0, 5.5, 23.9, 100.0}) {
        EXPECT_EQ(climate.at(hour).temperature_c, 22);
        EXPECT_EQ(climate.at(hour).relative_humidity, 0.5);
    }
}

TEST(Climate, HasTheNamedOnes) {
    ASSERT_EQ(climate_names().size(), 5U);
    for (const std::string& name : climate_names()) EXPECT_FALSE(named_climate(name).rows().empty()) << name;
    EXPECT_EQ(named_climate("temperate").at(13).temperature_c, 22);
    EXPECT_LT(named_climate("fridge").at(13).temperature_c, 8);
    EXPECT_GT(named_climate("hot-desert").at(15).temperature_c,
              named_climate("hot-desert").at(4).temperature_c);
    EXPECT_GT(named_climate("tropical").at(12).relative_humidity, 0.6);
}

TEST(Climate, SaysWhatCannotBe) {
    EXPECT_NE(message_of([] { constant_climate(22, 1.4); }).find("140 %"), std::string::npos);
    EXPECT_NE(message_of([] { constant_climate(90, 0.4); }).find("90 C"), std::string::npos);
    EXPECT_THROW(constant_climate(NAN, 0.4), InputError);
    EXPECT_THROW(Climate({}), InputError);
    EXPECT_NE(message_of([] { Climate({{6, 10, 0.5}, {6, 12, 0.5}}); }).find("row 2"), std::string::npos);
    EXPECT_THROW(Climate({{24, 10, 0.5}}), InputError);
    EXPECT_NE(message_of([] { named_climate("tropcal"); }).find("'tropical'"), std::string::npos);
}

}  // namespace
}  // namespace windfall::water
