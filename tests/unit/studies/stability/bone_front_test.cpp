#include "studies/stability/bone_front.h"

#include <gtest/gtest.h>

namespace osteomill::study::bone_front_test {
namespace {

TEST(BoneFront, ResistsNewGroundOnly) {
    BoneFront bone(100.0);
    EXPECT_DOUBLE_EQ(bone(0.002, 0.01), 100.0 * 0.2);
    EXPECT_EQ(bone(0.001, 0.01), 0.0) << "drawing back";
    EXPECT_EQ(bone(0.002, 0.01), 0.0) << "back to the front";
    EXPECT_DOUBLE_EQ(bone(0.003, 0.01), 100.0 * 0.1);
}

TEST(BoneFront, BeginsAtTheOrigin) {
    BoneFront bone(100.0);
    EXPECT_EQ(bone(-0.005, 0.01), 0.0);
    EXPECT_DOUBLE_EQ(bone(0.001, 0.01), 100.0 * 0.1);
}

}  // namespace
}  // namespace osteomill::study::bone_front_test
