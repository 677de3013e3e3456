#include <gtest/gtest.h>

#include "common/wire/bone_replica.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

TEST(RunningChecksum, StaysEqualToTheChecksumOfTheWholeBone) {
    std::mt19937 random(21);
    Bone bone = testing::make_speckled_bone(random);
    RunningChecksum running(bone);
    EXPECT_EQ(running.value(), checksum(bone));
    for (int round = 0; round < 100; ++round) {
        const auto slot = static_cast<std::int32_t>(random() % bone.stored_bricks());
        bone.fractions(slot)[random() % brick_voxel_count] = 0;
        running.update(bone, slot);
        ASSERT_EQ(running.value(), checksum(bone));
    }
    std::ranges::fill(bone.fractions(0), std::uint8_t{0});
    running.update(bone, 0);
    EXPECT_EQ(running.value(), checksum(bone));
}

}  // namespace
}  // namespace osteomill
