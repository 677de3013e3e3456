#include "common/wire/packed_changes.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::string bytes_packed(const std::string& content) {
    std::string packed(ZSTD_compressBound(content.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), 1));
    return packed;
}

class PackedChangesTest : public ::testing::Test {
  protected:
    /// Lowers voxels at random and says which.
    std::vector<BrickChange> carve(std::size_t voxels_of_brick) {
        std::vector<BrickChange> changed;
        for (std::int32_t slot = 0; slot < 6; ++slot) {
            BrickChange brick{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(slot)]};
            for (std::size_t i = 0; i < voxels_of_brick; ++i) {
                const std::size_t voxel = random_() % brick_voxel_count;
                std::uint8_t& fraction = bone_.fractions(slot)[voxel];
                fraction = static_cast<std::uint8_t>(random_() % (fraction + 1U));
                brick.voxels.set(voxel);
            }
            changed.push_back(brick);
        }
        return changed;
    }
    std::string error_of(const v2::PackedChanges& message) const {
        std::vector<ChangedBrick> changes;
        const auto error = unpack(message, ChangeKind::milled, bone_.content().size_bricks, changes);
        return error ? error->line : "";
    }
    v2::PackedChanges of_one_brick(const std::string& content) const {
        v2::PackedChanges message;
        message.add_brick(0);
        message.set_zstd_masks_and_fractions(bytes_packed(content));
        return message;
    }

    std::mt19937 random_{3};
    Bone bone_ = testing::make_speckled_bone(random_);
    Bone copy_ = bone_;
    ChangePacker packer_;
};

TEST_F(PackedChangesTest, AreTheChangesThatWerePacked) {
    for (const std::size_t voxels : {1U, 50U, 2000U}) {
        const std::vector<BrickChange> changes = carve(voxels);
        v2::PackedChanges arrived;
        ASSERT_TRUE(arrived.ParseFromString(packer_.pack(bone_, changes).SerializeAsString()));
        std::vector<ChangedBrick> unpacked;
        ASSERT_FALSE(unpack(arrived, ChangeKind::milled, bone_.content().size_bricks, unpacked));
        ASSERT_EQ(unpacked.size(), changes.size());
        for (std::size_t i = 0; i < changes.size(); ++i) {
            EXPECT_EQ(unpacked[i].change, changes[i]);
            ASSERT_TRUE(apply(unpacked[i].change, unpacked[i].fractions, copy_));
        }
        EXPECT_EQ(checksum(copy_), checksum(bone_));
    }
}

TEST_F(PackedChangesTest, AreRefusedWhereTheyDoNotAddUp) {
    EXPECT_EQ(error_of(of_one_brick(std::string(mask_bytes, '\0'))), "");
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes - 1, '\0'))), HasSubstr("lack masks"));
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes, '\x01'))), HasSubstr("lack fractions"));
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes + 1, '\0'))), HasSubstr("more fractions"));
    EXPECT_THAT(error_of(of_one_brick(std::string(largest_packed_changes_bytes + 1, '\0'))),
                HasSubstr("refused"));
    v2::PackedChanges message = of_one_brick(std::string(mask_bytes, '\0'));
    message.set_brick(0, 4'000'000'000U);
    EXPECT_THAT(error_of(message), HasSubstr("outside the grid"));
    message.clear_brick();
    EXPECT_THAT(error_of(message), HasSubstr("of 0 bricks"));
    for (std::size_t i = 0; i <= largest_packed_changes_bytes / mask_bytes; ++i) message.add_brick(0);
    EXPECT_THAT(error_of(message), HasSubstr("not 1 to 128"));
    message = of_one_brick(std::string(mask_bytes, '\0'));
    message.set_zstd_masks_and_fractions("no zstd");
    EXPECT_THAT(error_of(message), HasSubstr("refused"));
}

}  // namespace
}  // namespace osteomill
