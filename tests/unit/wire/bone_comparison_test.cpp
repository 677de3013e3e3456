#include "common/wire/bone_comparison.h"

#include <gmock/gmock.h>

#include <limits>
#include <utility>

#include "common/bone/bone_builder.h"

namespace osteomill {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

class BoneComparisonTest : public ::testing::Test {
  protected:
    BoneComparisonTest() {
        // 8192 bricks, of which 3 in 4 are stored.
        auto builder = BoneBuilder::homogeneous({.size_voxels = {512, 256, 256}}, 1.0, false);
        ByteBrick fraction{};
        for (BrickIndex brick = 0; brick < 8192; ++brick) {
            fraction.fill(static_cast<std::uint8_t>(1 + brick % 254));
            if (brick % 4 != 1)
                builder.add_brick(brick_position({32, 16, 16}, brick), fraction, nullptr, nullptr);
        }
        bone_.emplace(std::move(builder).build());
        copy_ = bone_;
    }
    /// Changes one voxel of the copy.
    BrickIndex spoil(std::size_t slot) {
        std::uint8_t& voxel = copy_->fractions(static_cast<std::int32_t>(slot))[slot % brick_voxel_count];
        voxel = static_cast<std::uint8_t>(voxel + 1);
        return bone_->content().brick_of_slot[slot];
    }
    std::string refusal_of(const v2::CompareBone& request) {
        const auto compared = compare_bone(request, *bone_, RunningChecksum(*bone_));
        const auto* error = std::get_if<WireError>(&compared);
        return error != nullptr ? error->line : "";
    }
    static v2::CompareBone request(BrickIndex first, std::uint64_t count, std::uint64_t per_part,
                                   int checksums) {
        v2::CompareBone request;
        add_range(request, first, count, per_part, checksums);
        return request;
    }
    static void add_range(v2::CompareBone& request, BrickIndex first, std::uint64_t count,
                          std::uint64_t per_part, int checksums) {
        v2::BrickRange& range = *request.add_ranges();
        range.set_first_brick(first);
        range.set_brick_count(count);
        range.set_bricks_per_part(per_part);
        for (int i = 0; i < checksums; ++i) range.add_part_checksum(7);
    }

    std::optional<Bone> bone_;
    std::optional<Bone> copy_;
};

TEST_F(BoneComparisonTest, FindsExactlyTheBricksThatDifferWithFewSmallRequests) {
    std::vector<BrickIndex> spoilt;
    for (const std::size_t slot : {std::size_t{0}, std::size_t{1000}, std::size_t{1001}, std::size_t{3777},
                                   bone_->stored_bricks() - 1})
        spoilt.push_back(spoil(slot));
    const RunningChecksum theirs(*bone_);
    const RunningChecksum ours(*copy_);
    DifferenceSearch search(*copy_);
    std::vector<BrickIndex> found;
    while (const auto asked = search.next(*copy_, ours)) {
        EXPECT_LT(asked->ByteSizeLong(), 3072U);
        const auto compared = compare_bone(*asked, *bone_, theirs);
        ASSERT_TRUE(std::holds_alternative<ComparedBone>(compared)) << std::get<WireError>(compared).line;
        const auto& result = std::get<ComparedBone>(compared);
        found.insert(found.end(), result.differing_bricks.begin(), result.differing_bricks.end());
        EXPECT_FALSE(search.take(result.answer));
    }
    EXPECT_THAT(found, ElementsAreArray(spoilt));
    EXPECT_EQ(search.bricks_found(), spoilt.size());
    EXPECT_LE(search.requests(), 4);
}

TEST_F(BoneComparisonTest, FindsNothingInAnEqualCopyWithOneRequest) {
    const RunningChecksum checksum(*bone_);
    DifferenceSearch search(*bone_);
    const auto asked = search.next(*bone_, checksum);
    ASSERT_TRUE(asked);
    EXPECT_FALSE(search.take(std::get<ComparedBone>(compare_bone(*asked, *bone_, checksum)).answer));
    EXPECT_FALSE(search.next(*bone_, checksum));
}

TEST_F(BoneComparisonTest, RefusesRequestsThatMakeNoSense) {
    const std::uint64_t all = 32 * 16 * 16;
    EXPECT_THAT(refusal_of({}), HasSubstr("0 parts, not 1 to 128"));
    EXPECT_THAT(refusal_of(request(0, 129, 1, 129)), HasSubstr("129 parts"));
    EXPECT_THAT(refusal_of(request(0, 0, 1, 0)), HasSubstr("empty"));
    EXPECT_THAT(refusal_of(request(0, 10, 0, 1)), HasSubstr("empty"));
    EXPECT_THAT(refusal_of(request(0, 10, 3, 3)), HasSubstr("more or fewer checksums"));
    EXPECT_THAT(refusal_of(request(0, all + 1, all + 1, 1)), HasSubstr("past the grid's 8192"));
    EXPECT_THAT(refusal_of(request(9000, 1, 1, 1)), HasSubstr("past the grid"));
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    EXPECT_THAT(refusal_of(request(5, most, most, 1)), HasSubstr("past the grid"));
    v2::CompareBone overlapping = request(0, 10, 5, 2);
    add_range(overlapping, 9, 10, 5, 2);
    EXPECT_THAT(refusal_of(overlapping), HasSubstr("overlap"));
    EXPECT_EQ(refusal_of(request(0, all, all, 1)), "");
    EXPECT_EQ(refusal_of(request(0, 10, most, 1)), "");
}

TEST_F(BoneComparisonTest, RefusesAnswersThatWereNotAskedFor) {
    DifferenceSearch search(*bone_);
    v2::Comparison answer;
    EXPECT_TRUE(search.take(answer));
    for (const std::vector<std::uint32_t>& parts :
         std::vector<std::vector<std::uint32_t>>{{128}, {0xFFFFFFFF}, {3, 3}, {4, 2}}) {
        DifferenceSearch asking(*bone_);
        ASSERT_TRUE(asking.next(*bone_, RunningChecksum(*bone_)));
        answer.mutable_differing_part()->Assign(parts.begin(), parts.end());
        EXPECT_TRUE(asking.take(answer));
    }
}

TEST(BoneComparison, HasNothingToAskAboutABoneWithoutBricks) {
    const Bone bone = BoneBuilder::homogeneous({.size_voxels = {20, 20, 20}}, 1.0, false).build();
    EXPECT_FALSE(DifferenceSearch(bone).next(bone, RunningChecksum(bone)));
}

}  // namespace
}  // namespace osteomill
