#include "common/scene/stiffness_relation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace osteomill {
namespace {

TEST(StiffnessRelation, IsOneForTheReferenceBoneAndFollowsKeyakAboveIt) {
    const StiffnessRelation relation = default_stiffness_relation();
    EXPECT_NO_THROW(require_valid(relation));
    EXPECT_DOUBLE_EQ(relative_stiffness(relation, reference_bone_hu), 1.0);
    for (const double hu : {330.0, 450.0, 700.0, 1100.0, 1700.0, 2600.0})
        EXPECT_NEAR(relative_stiffness(relation, hu) / std::pow(hu / 1600.0, 1.72), 1.0, 0.01) << hu << " HU";
}

TEST(StiffnessRelation, HoldsItsEndsAndIsStraightBetweenKnots) {
    const StiffnessRelation relation{{{0.0, 0.5}, {100.0, 1.5}}};
    EXPECT_EQ(relative_stiffness(relation, -1000.0), 0.5);
    EXPECT_EQ(relative_stiffness(relation, 25.0), 0.75);
    EXPECT_EQ(relative_stiffness(relation, 5000.0), 1.5);
}

TEST(StiffnessRelation, RefusesKnotsThatCannotBe) {
    EXPECT_THROW(require_valid(StiffnessRelation{}), std::invalid_argument);
    EXPECT_THROW(require_valid(StiffnessRelation{{{100.0, 1.0}, {100.0, 2.0}}}), std::invalid_argument);
    EXPECT_THROW(require_valid(StiffnessRelation{{{100.0, 0.0}}}), std::invalid_argument);
    EXPECT_THROW(require_valid(StiffnessRelation{{{100.0, 5.2}}}), std::invalid_argument);
    EXPECT_THROW(require_valid(StiffnessRelation{{{std::nan(""), 1.0}}}), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill
