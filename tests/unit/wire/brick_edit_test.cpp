#include "common/wire/brick_edit.h"

#include <gmock/gmock.h>

#include "common/wire/frame.h"
#include "tests/support/block.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BrickEditMessage : public ::testing::Test {
  protected:
    std::string error_of(const v1::BrickEdit& edit) {
        const std::uint64_t before = checksum(bone_);
        const auto error = apply_brick_edit(edit, bone_);
        if (!error) return "";
        EXPECT_EQ(checksum(bone_), before) << "a refused edit changed the bone";
        return error->line;
    }
    /// One run of fractions 100.
    static v1::BrickEdit run(BrickIndex brick, std::uint32_t first, std::uint32_t length) {
        v1::BrickEdit edit;
        edit.set_brick(brick);
        edit.add_changed(first);
        edit.add_changed(length);
        edit.set_fraction(std::string(length, 100));
        return edit;
    }

    Bone bone_ = testing::make_block({0, 0, 0}, {3.2, 1.6, 1.6}, 0.1);  // two full bricks
};

TEST_F(BrickEditMessage, HoldsTheChangedVoxelsAsRunsAndNoOthers) {
    auto fractions = bone_.fractions(1);
    VoxelMask changed;
    for (const std::size_t voxel : {0U, 1U, 2U, 17U, 4094U, 4095U}) {
        changed.set(voxel);
        fractions[voxel] = static_cast<std::uint8_t>(voxel % 200);
    }
    const v1::BrickEdit edit = brick_edit({1, changed}, fractions);
    EXPECT_EQ(edit.brick(), 1U);
    EXPECT_THAT(edit.changed(), ElementsAre(0, 3, 17, 1, 4094, 2));
    EXPECT_THAT(std::vector<int>(edit.fraction().begin(), edit.fraction().end()),
                ElementsAre(0, 1, 2, 17, 94, 95));
}

TEST_F(BrickEditMessage, MakesRandomlyCarvedCopiesEqual) {
    std::mt19937 random(9);
    for (int round = 0; round < 50; ++round) {
        Bone carved = testing::make_speckled_bone(random);
        Bone copy = carved;
        std::vector<VoxelMask> changed(carved.stored_bricks());
        for (int i = 0; i < 20000; ++i) {
            const auto slot = random() % carved.stored_bricks();
            const auto voxel = random() % brick_voxel_count;
            std::uint8_t& fraction = carved.fractions(static_cast<std::int32_t>(slot))[voxel];
            if (fraction == 0) continue;
            fraction = static_cast<std::uint8_t>(random() % fraction);
            changed[slot].set(voxel);
        }
        for (std::size_t slot = 0; slot < changed.size(); ++slot) {
            const auto edit = brick_edit({carved.content().brick_of_slot[slot], changed[slot]},
                                         carved.fractions(static_cast<std::int32_t>(slot)));
            v1::BrickEdit arrived;
            ASSERT_TRUE(arrived.ParseFromString(edit.SerializeAsString()));
            ASSERT_FALSE(apply_brick_edit(arrived, copy));
            ASSERT_FALSE(apply_brick_edit(arrived, copy)) << "a second time";
        }
        EXPECT_EQ(checksum(copy), checksum(carved));
    }
}

TEST_F(BrickEditMessage, RefusesWhatDoesNotFitTheBrick) {
    EXPECT_EQ(error_of(run(0, 4090, 6)), "");
    EXPECT_THAT(error_of(run(0, 4090, 7)), HasSubstr("4097 of 4096"));
    EXPECT_THAT(error_of(run(0, 4'294'967'295U, 1)), HasSubstr("4294967296 of 4096"));
    EXPECT_THAT(error_of(run(0, 5, 0)), HasSubstr("empty"));
    EXPECT_THAT(error_of(run(2, 0, 1)), HasSubstr("no bone"));
    EXPECT_THAT(error_of(run(4'294'967'295U, 0, 1)), HasSubstr("no bone"));
}

TEST_F(BrickEditMessage, RefusesRunsAndFractionsThatDoNotAgree) {
    v1::BrickEdit edit = run(0, 10, 5);
    edit.add_changed(100);
    EXPECT_THAT(error_of(edit), HasSubstr("lacks its length"));
    edit.add_changed(1);
    EXPECT_THAT(error_of(edit), HasSubstr("too few"));
    edit.set_fraction(std::string(7, 0));
    EXPECT_THAT(error_of(edit), HasSubstr("more fractions"));
    edit.set_fraction(std::string(6, 0));
    edit.set_changed(2, 14);  // overlaps the first run
    EXPECT_THAT(error_of(edit), HasSubstr("ascend"));
    edit = run(0, 10, 1);
    edit.set_changed(1, 4'294'967'295U);
    EXPECT_NE(error_of(edit), "");
}

TEST_F(BrickEditMessage, RefusesToRaiseWhatIsLeft) {
    EXPECT_EQ(error_of(run(1, 30, 3)), "");
    v1::BrickEdit edit = run(1, 29, 3);
    edit.mutable_fraction()->at(1) = 101;
    EXPECT_THAT(error_of(edit), HasSubstr("raises what is left of voxel 30"));
}

TEST_F(BrickEditMessage, ThatCorrectsACopyGivesBackBoneButNoneOutsideTheGrid) {
    EXPECT_EQ(std::get<EditEffect>(correct_with_brick_edit(run(1, 30, 3), bone_)), EditEffect::lowers);
    v1::BrickEdit edit = run(1, 30, 3);
    edit.set_fraction(std::string(3, 101));
    EXPECT_EQ(std::get<EditEffect>(correct_with_brick_edit(edit, bone_)), EditEffect::raises);

    Bone cut = testing::make_block({0, 0, 0}, {2.0, 1.6, 1.6}, 0.1);  // of the second brick, 4 voxels along x
    const std::uint64_t before = checksum(cut);
    const auto refused = correct_with_brick_edit(run(1, 1, 4), cut);
    ASSERT_TRUE(std::holds_alternative<WireError>(refused));
    EXPECT_THAT(std::get<WireError>(refused).line, HasSubstr("voxel 4 lies outside the grid"));
    EXPECT_EQ(checksum(cut), before);
    EXPECT_TRUE(std::holds_alternative<EditEffect>(correct_with_brick_edit(run(1, 0, 4), cut)));
}

TEST_F(BrickEditMessage, OfTheWorstBrickIsSmallBesideAFrame) {
    VoxelMask alternating;
    for (std::size_t voxel = 0; voxel < brick_voxel_count; voxel += 2) alternating.set(voxel);
    EXPECT_LT(brick_edit({1, alternating}, bone_.fractions(1)).ByteSizeLong(), largest_frame_bytes / 8);
}

}  // namespace
}  // namespace osteomill
