#include "simulation/force_models/removal_account.h"

#include <gtest/gtest.h>

namespace osteomill::removal_account_test {
namespace {

Tissue tissue(std::uint8_t label, bool is_protected) {
    Tissue made;
    made.label = label;
    made.is_protected = is_protected;
    return made;
}

class RemovalAccountTest : public ::testing::Test {
  protected:
    MillingResult step(std::uint8_t label, double levels) {
        MillingResult result;
        account_.begin_step(0.0, result);
        account_.take(label, levels);
        account_.end_step({}, result);
        return result;
    }

    RemovalAccount account_{{.size_voxels = glm::ivec3(16)}, {tissue(1, false), tissue(2, true)}};
};

TEST_F(RemovalAccountTest, ProtectedTissueIsTouchedWhereItLosesBone) {
    EXPECT_TRUE(step(2, 3.0).touches_protected);
    EXPECT_FALSE(step(1, 255.0).touches_protected);
    EXPECT_FALSE(step(2, 0.0).touches_protected) << "visited, and left as it was";
}

TEST_F(RemovalAccountTest, VolumesAddUpByTissue) {
    step(1, 255.0);
    const MillingResult last = step(2, 51.0);
    const double voxel_mm3 = voxel_volume_mm3(Grid{.size_voxels = glm::ivec3(16)});
    EXPECT_NEAR(last.removed_mm3, 0.2 * voxel_mm3, 1e-15);
    EXPECT_NEAR(last.total_removed_mm3, 1.2 * voxel_mm3, 1e-15);
    EXPECT_NEAR(account_.removed_mm3()[1], voxel_mm3, 1e-15);
}

}  // namespace
}  // namespace osteomill::removal_account_test
