#include "haptic_server/exchange/edit_queue.h"

#include <algorithm>
#include <utility>

namespace osteomill {

EditQueue::EditQueue(std::size_t capacity, std::shared_ptr<const BoneContent> content)
    : queue_(capacity), content_(std::move(content)), is_overflowed_(content_->brick_of_slot.size(), false) {
    overflowed_.reserve(is_overflowed_.size());
}

void EditQueue::push(const EditRun& run) noexcept {
    // Once a brick waits to be sent again, its later runs wait with it: order within a brick is kept.
    if (has_overflowed() && is_overflowed_[slot_of(run)]) return;
    if (queue_.push(run)) return;
    overflow_count_.fetch_add(1, std::memory_order_relaxed);
    is_overflowed_[slot_of(run)] = true;
    overflowed_.push_back(slot_of(run));
}

void EditQueue::resend_overflowed(const Bone& bone) noexcept {
    constexpr std::size_t rows = brick_voxel_count / brick_edge_voxels;
    while (!overflowed_.empty() && queue_.write_available() >= rows) {
        const std::size_t slot = overflowed_.back();
        overflowed_.pop_back();
        is_overflowed_[slot] = false;
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        for (std::size_t row = 0; row < rows; ++row) {
            EditRun run{.brick = content_->brick_of_slot[slot],
                        .first_voxel = static_cast<std::uint16_t>(row * brick_edge_voxels),
                        .count = brick_edge_voxels};
            std::copy_n(fractions.begin() + static_cast<std::ptrdiff_t>(row * brick_edge_voxels),
                        brick_edge_voxels, run.fraction.begin());
            queue_.push(run);
        }
    }
}

}  // namespace osteomill
