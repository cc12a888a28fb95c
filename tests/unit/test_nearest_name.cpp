#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/nearest_name.h"

namespace windfall {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, CountsInsertionsRemovalsReplacementsAndSwaps) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("gamma", "gamam"), 1u);  // a swap is one mistake, not two
    EXPECT_EQ(edit_distance("raisin", "raisins"), 1u);
    EXPECT_EQ(edit_distance("raisins", "raisin"), 1u);
}

TEST(NearestNames, OrdersByDistanceAndLeavesOutWhatIsFar) {
    const std::vector<std::string> presets = {"jujube", "jujube-plump", "plum", "plum-round", "raisin"};
    EXPECT_THAT(nearest_names("jujub", presets), ElementsAre("jujube"));
    EXPECT_THAT(nearest_names("plumm", presets, 3), ElementsAre("plum"));
    EXPECT_THAT(nearest_names("walnut", presets), IsEmpty());
    EXPECT_THAT(nearest_names("", presets), IsEmpty());
}

TEST(NearestNames, FindsTheTableOfABareKey) {
    const std::vector<std::string> keys = {"material.gamma", "mesh.n", "fruit.skin_thickness"};
    EXPECT_THAT(nearest_names("gamma", keys), ElementsAre("material.gamma"));
    EXPECT_THAT(nearest_names("fruit.gamma", keys), ElementsAre("material.gamma"));
    EXPECT_THAT(nearest_names("fruit.skin_thicknes", keys), ElementsAre("fruit.skin_thickness"));
    EXPECT_THAT(nearest_names("colour", keys), IsEmpty());
}

}  // namespace
}  // namespace windfall
