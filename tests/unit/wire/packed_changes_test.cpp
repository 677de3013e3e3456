#include "common/wire/packed_changes.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include "common/wire/brick_edit.h"
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
    std::string error_of(const v1::PackedChanges& message) const {
        const auto edits = unpack(message, bone_.content().size_bricks);
        const auto* error = std::get_if<WireError>(&edits);
        return error != nullptr ? error->line : "";
    }
    v1::PackedChanges of_one_brick(const std::string& content) const {
        v1::PackedChanges message;
        message.add_brick(0);
        message.set_zstd_masks_and_fractions(bytes_packed(content));
        return message;
    }

    std::mt19937 random_{3};
    Bone bone_ = testing::make_speckled_bone(random_);
    Bone copy_ = bone_;
    ChangePacker packer_;
};

TEST_F(PackedChangesTest, AreTheEditsThatWerePacked) {
    for (const std::size_t voxels : {1U, 50U, 2000U}) {
        const std::vector<BrickChange> changes = carve(voxels);
        v1::PackedChanges arrived;
        ASSERT_TRUE(arrived.ParseFromString(packer_.pack(bone_, changes).SerializeAsString()));
        const auto edits = unpack(arrived, bone_.content().size_bricks);
        ASSERT_TRUE(std::holds_alternative<std::vector<v1::BrickEdit>>(edits)) << error_of(arrived);
        ASSERT_EQ(std::get<0>(edits).size(), changes.size());
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const v1::BrickEdit& edit = std::get<0>(edits)[i];
            const auto as_it_is = brick_edit(changes[i], bone_.fractions(bone_.slot(changes[i].brick)));
            EXPECT_EQ(edit.SerializeAsString(), as_it_is.SerializeAsString());
            ASSERT_FALSE(apply_brick_edit(edit, copy_));
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
    v1::PackedChanges message = of_one_brick(std::string(mask_bytes, '\0'));
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
