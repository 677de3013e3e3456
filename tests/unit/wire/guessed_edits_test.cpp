#include "common/wire/guessed_edits.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include "common/wire/brick_edit.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

std::string bytes_packed(const std::string& differences) {
    std::string packed(ZSTD_compressBound(differences.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), differences.data(), differences.size(), 1));
    return packed;
}

class GuessedEditsTest : public ::testing::Test {
  protected:
    /// Lowers voxels at random and says which.
    std::vector<ChangedBrick> carve(std::size_t voxels_of_brick) {
        std::vector<ChangedBrick> changed;
        for (std::int32_t slot = 0; slot < 6; ++slot) {
            ChangedBrick brick{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(slot)]};
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
    std::string error_of(const v1::GuessedEdits& message) const {
        const auto edits = unpack(message, bone_.content().size_bricks);
        const auto* error = std::get_if<WireError>(&edits);
        return error != nullptr ? error->line : "";
    }
    v1::GuessedEdits of_one_brick(const std::string& differences) const {
        v1::GuessedEdits message;
        message.add_brick(0);
        message.set_zstd_differences(bytes_packed(differences));
        return message;
    }

    std::mt19937 random_{3};
    Bone bone_ = testing::make_speckled_bone(random_);
    Bone copy_ = bone_;
    GuessedEditsPacker packer_;
};

TEST_F(GuessedEditsTest, AreTheEditsThatWerePackedWhateverTheGuess) {
    for (const auto& sweep :
         {guessed_sweep({20.0, 12.0, 20.0}, {22.0, 13.0, 18.5}, 9.0, 0.7),  // in the middle of it
          guessed_sweep({-50.0, -50.0, 0.0}, {-50.0, -48.0, 0.0}, 9.0),     // nowhere near
          std::optional<GuessedSweep>()}) {
        for (const std::size_t voxels : {1U, 50U, 2000U}) {
            const std::vector<ChangedBrick> changed = carve(voxels);
            v1::GuessedEdits arrived;
            ASSERT_TRUE(arrived.ParseFromString(packer_.pack(bone_, changed, sweep).SerializeAsString()));
            const auto edits = unpack(arrived, bone_.content().size_bricks);
            ASSERT_TRUE(std::holds_alternative<std::vector<v1::BrickEdit>>(edits)) << error_of(arrived);
            ASSERT_EQ(std::get<0>(edits).size(), changed.size());
            for (std::size_t i = 0; i < changed.size(); ++i) {
                const v1::BrickEdit& edit = std::get<0>(edits)[i];
                const auto as_it_is = brick_edit(
                    changed[i].brick, bone_.fractions(bone_.slot(changed[i].brick)), changed[i].voxels);
                EXPECT_EQ(edit.SerializeAsString(), as_it_is.SerializeAsString());
                ASSERT_FALSE(apply_brick_edit(edit, copy_));
            }
            EXPECT_EQ(checksum(copy_), checksum(bone_));
        }
    }
}

TEST_F(GuessedEditsTest, AreRefusedWhereTheyDoNotAddUp) {
    EXPECT_EQ(error_of(of_one_brick(std::string(mask_bytes, '\0'))), "");
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes - 1, '\0'))), HasSubstr("lack masks"));
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes, '\x01'))), HasSubstr("lack fractions"));
    EXPECT_THAT(error_of(of_one_brick(std::string(mask_bytes + 1, '\0'))), HasSubstr("more fractions"));
    EXPECT_THAT(error_of(of_one_brick(std::string(largest_guessed_edits_bytes + 1, '\0'))),
                HasSubstr("refused"));
    v1::GuessedEdits message = of_one_brick(std::string(mask_bytes, '\0'));
    message.set_brick(0, 4'000'000'000U);
    EXPECT_THAT(error_of(message), HasSubstr("outside the grid"));
    message.clear_brick();
    EXPECT_THAT(error_of(message), HasSubstr("of 0 bricks"));
    for (std::size_t i = 0; i <= largest_guessed_edits_bytes / mask_bytes; ++i) message.add_brick(0);
    EXPECT_THAT(error_of(message), HasSubstr("not 1 to 128"));
    message = of_one_brick(std::string(mask_bytes, '\0'));
    message.set_zstd_differences("no zstd");
    EXPECT_THAT(error_of(message), HasSubstr("refused"));
    message.mutable_sweep();
    EXPECT_THAT(error_of(message), HasSubstr("guessed sweep"));
}

}  // namespace
}  // namespace osteomill
