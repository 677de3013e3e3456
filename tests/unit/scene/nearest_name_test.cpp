#include "common/scene/nearest_name.h"

#include <gtest/gtest.h>

namespace osteomill {
namespace {

TEST(NearestName, CountsTheChangesBetweenWords) {
    EXPECT_EQ(edit_distance("", "edges"), 5U);
    EXPECT_EQ(edit_distance("edges", "edges"), 0U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(NearestName, FindsTheSlipAndTheForgottenUnit) {
    const std::vector<std::string> names{"name", "diameter_mm", "edges", "rpm", "speed_mm_per_s"};
    EXPECT_EQ(nearest_name("nmae", names), "name") << "two letters of four, swapped";
    EXPECT_EQ(nearest_name("diametre_mm", names), "diameter_mm");
    EXPECT_EQ(nearest_name("speed", names), "speed_mm_per_s");
    EXPECT_EQ(nearest_name("edge", names), "edges");
}

TEST(NearestName, DoesNotGuessWhenNothingIsNear) {
    EXPECT_EQ(nearest_name("teeth", {"name", "edges", "rpm"}), std::nullopt);
    EXPECT_EQ(nearest_name("", {"name"}), std::nullopt);
    EXPECT_EQ(nearest_name("name", {}), std::nullopt);
}

}  // namespace
}  // namespace osteomill
