#include "simulation/exchange/change_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include "tests/support/block.h"
#include "tests/support/random_carving.h"

namespace osteomill::change_queue_test {
namespace {

Bone small_block() {
    return testing::make_block(glm::dvec3(0.0), glm::dvec3(3.2), 0.1);
}

/// Lowers one voxel and tells the queue.
void carve(Bone& bone, ChangeQueue& queue, BrickIndex brick, std::size_t voxel, std::uint8_t left) {
    const auto fractions = bone.fractions(bone.slot(brick));
    fractions[voxel] = left;
    queue.push({brick, VoxelMask().set(voxel)}, fractions);
}

/// Applies the queue's changes; returns their number.
std::size_t follow(ChangeQueue& queue, Bone& copy) {
    return queue.consume_all([&](const BrickChange& change, BrickFractions fractions) {
        EXPECT_TRUE(apply(change, fractions, copy));
    });
}

TEST(ChangeQueue, HandsOverChangesInOrderAsTheyWereWhenPushed) {
    ChangeQueue queue(1 << 16, small_block().shared_content());
    std::vector<BrickChange> pushed{{1, VoxelMask().set(0)},
                                    {7, VoxelMask().set_run(61, 3).set(64).set(4095)},
                                    {1, VoxelMask().set_all()},
                                    {3, VoxelMask().set(5), ChangeKind::restored},
                                    {0, VoxelMask()}};
    std::uint8_t left = 200;
    for (const BrickChange& change : pushed) {
        ByteBrick fractions;
        fractions.fill(left--);
        queue.push(change, fractions);
    }
    std::vector<BrickChange> received;
    left = 200;
    const auto take = [&](const BrickChange& change, BrickFractions fractions) {
        received.push_back(change);
        change.voxels.for_each([&](std::size_t voxel) { ASSERT_EQ(fractions[voxel], left); });
        --left;
    };
    EXPECT_EQ(queue.consume_all(take), 5U);
    EXPECT_EQ(received, pushed);
    EXPECT_EQ(queue.consume_all(take), 0U);
    EXPECT_EQ(queue.overflow_count(), 0U);
}

TEST(ChangeQueue, HandsOverWhatGoesRoundTheEndOfTheRing) {
    Bone bone = small_block();
    Bone copy = bone;
    ChangeQueue queue(1, bone.shared_content());
    std::mt19937 random(11);
    for (int round = 0; round < 1000; ++round) {
        for (int i = 0; i < 10; ++i) testing::carve_somewhere(bone, random, queue);
        ASSERT_EQ(follow(queue, copy), 10U);
    }
    EXPECT_EQ(checksum(copy), checksum(bone));
    EXPECT_EQ(queue.overflow_count(), 0U);
}

TEST(ChangeQueue, HasRoomForAWholeBrickHoweverSmallItIsAskedToBe) {
    Bone bone = small_block();
    Bone copy = bone;
    ChangeQueue queue(1, bone.shared_content());
    std::ranges::fill(bone.fractions(3), std::uint8_t{9});
    queue.push({3, VoxelMask().set_all()}, bone.fractions(3));
    EXPECT_FALSE(queue.has_overflowed());
    EXPECT_EQ(follow(queue, copy), 1U);
    EXPECT_EQ(checksum(copy), checksum(bone));
}

TEST(ChangeQueue, KeepsNothingThatNobodyReads) {
    Bone bone = small_block();
    ChangeQueue queue(0, bone.shared_content());
    for (int i = 0; i < 100; ++i) queue.push({3, VoxelMask().set_all()}, bone.fractions(3));
    EXPECT_FALSE(queue.has_overflowed());
    EXPECT_EQ(queue.overflow_count(), 0U);
    queue.resend_overflowed(bone);
    EXPECT_EQ(follow(queue, bone), 0U);
}

TEST(ChangeQueue, LosesNoBoneWhenItOverflows) {
    Bone bone = small_block();
    Bone copy = bone;
    ChangeQueue queue(6000, bone.shared_content());  // one whole brick and a few voxels
    for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
        for (BrickIndex brick = 0; brick < 8; ++brick) carve(bone, queue, brick, voxel, 7);
    EXPECT_TRUE(queue.has_overflowed());
    EXPECT_GT(queue.overflow_count(), 0u);

    for (int i = 0; i < 20 && queue.has_overflowed(); ++i) {
        follow(queue, copy);
        queue.resend_overflowed(bone);
    }
    follow(queue, copy);
    EXPECT_FALSE(queue.has_overflowed());
    EXPECT_EQ(checksum(copy), checksum(bone));
}

TEST(ChangeQueue, KeepsACopyOnAnotherThreadEqualHoweverSlowItIs) {
    Bone bone = small_block();
    Bone copy = bone;
    ChangeQueue queue(8192, bone.shared_content());
    std::atomic<bool> done{false};
    std::thread consumer([&] {
        bool last_round = false;
        while (!last_round) {
            last_round = done.load();
            follow(queue, copy);
            std::this_thread::yield();
        }
    });
    for (int left = 200; left > 0; left -= 50) {
        for (std::size_t voxel = 0; voxel < brick_voxel_count; voxel += 3) {
            carve(bone, queue, voxel % 8U, voxel, static_cast<std::uint8_t>(left));
            if (voxel % 64 == 0) queue.resend_overflowed(bone);
        }
    }
    while (queue.has_overflowed()) queue.resend_overflowed(bone);
    done.store(true);
    consumer.join();
    EXPECT_EQ(checksum(copy), checksum(bone));
}

}  // namespace
}  // namespace osteomill::change_queue_test
