#include "haptic_server/loop/edit_queue.h"

#include <algorithm>

namespace osteomill {

EditQueue::EditQueue(std::size_t capacity, std::size_t brick_count)
    : queue_(capacity), is_overflowed_(brick_count, false) {
    overflowed_.reserve(brick_count);
}

void EditQueue::push(const EditRun& run) noexcept {
    // Once a brick waits to be sent again, its later runs wait with it: order within a brick is kept.
    if (is_overflowed_[run.brick]) return;
    if (queue_.push(run)) return;
    overflow_count_.fetch_add(1, std::memory_order_relaxed);
    is_overflowed_[run.brick] = true;
    overflowed_.push_back(run.brick);
}

void EditQueue::resend_overflowed(const Bone& bone) noexcept {
    constexpr std::size_t rows = brick_voxel_count / brick_edge_voxels;
    while (!overflowed_.empty() && queue_.write_available() >= rows) {
        const BrickIndex brick = overflowed_.back();
        overflowed_.pop_back();
        is_overflowed_[brick] = false;
        const auto fractions = bone.fractions(bone.content().slot_of_brick[brick]);
        for (std::size_t row = 0; row < rows; ++row) {
            EditRun run{.brick = brick,
                        .first_voxel = static_cast<std::uint16_t>(row * brick_edge_voxels),
                        .count = brick_edge_voxels};
            std::copy_n(fractions.begin() + static_cast<std::ptrdiff_t>(row * brick_edge_voxels),
                        brick_edge_voxels, run.fraction.begin());
            queue_.push(run);
        }
    }
}

}  // namespace osteomill
