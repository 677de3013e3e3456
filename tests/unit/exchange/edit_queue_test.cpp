#include "haptic_server/exchange/edit_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/support/block.h"

namespace osteomill {
namespace {

Bone small_block() {
    return testing::make_block(glm::dvec3(0.0), glm::dvec3(3.2), 0.1);
}

/// Lowers one voxel and tells the queue.
void carve(Bone& bone, EditQueue& queue, BrickIndex brick, std::uint16_t voxel, std::uint8_t left) {
    bone.fractions(bone.slot(brick))[voxel] = left;
    queue.push({.brick = brick, .first_voxel = voxel, .count = 1, .fraction = {left}});
}

TEST(EditQueue, HandsOverRunsInOrder) {
    EditQueue queue(16, small_block().shared_content());
    for (std::uint16_t i = 0; i < 5; ++i) queue.push({.brick = 1, .first_voxel = i, .count = 1});
    std::uint16_t next = 0;
    EXPECT_EQ(queue.consume_all([&](const EditRun& run) { EXPECT_EQ(run.first_voxel, next++); }), 5u);
    EXPECT_EQ(queue.overflow_count(), 0u);
}

TEST(EditQueue, LosesNoBoneWhenItOverflows) {
    Bone bone = small_block();
    Bone copy = bone;
    EditQueue queue(300, bone.shared_content());  // one brick is 256 rows
    for (std::uint16_t voxel = 0; voxel < 4096; ++voxel) {
        for (BrickIndex brick = 0; brick < 8; ++brick) carve(bone, queue, brick, voxel, 7);
    }
    EXPECT_TRUE(queue.has_overflowed());
    EXPECT_GT(queue.overflow_count(), 0u);

    const auto drain = [&] {
        queue.consume_all([&](const EditRun& run) { EXPECT_EQ(apply(run, copy), EditOutcome::applied); });
    };
    for (int i = 0; i < 20 && queue.has_overflowed(); ++i) {
        drain();
        queue.resend_overflowed(bone);
    }
    drain();
    EXPECT_FALSE(queue.has_overflowed());
    EXPECT_EQ(checksum(copy), checksum(bone));
}

TEST(EditQueue, KeepsACopyOnAnotherThreadEqualHoweverSlowItIs) {
    Bone bone = small_block();
    Bone copy = bone;
    EditQueue queue(512, bone.shared_content());
    std::atomic<bool> done{false};
    std::thread consumer([&] {
        bool last_round = false;
        while (!last_round) {
            last_round = done.load();
            queue.consume_all([&](const EditRun& run) { apply(run, copy); });
            std::this_thread::yield();
        }
    });
    for (int left = 200; left > 0; left -= 50) {
        for (std::uint16_t voxel = 0; voxel < 4096; voxel += 3) {
            carve(bone, queue, voxel % 8u, voxel, static_cast<std::uint8_t>(left));
            if (voxel % 64 == 0) queue.resend_overflowed(bone);
        }
    }
    while (queue.has_overflowed()) queue.resend_overflowed(bone);
    done.store(true);
    consumer.join();
    EXPECT_EQ(checksum(copy), checksum(bone));
}

}  // namespace
}  // namespace osteomill
