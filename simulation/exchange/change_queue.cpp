#include "simulation/exchange/change_queue.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace osteomill {

static_assert(VoxelMask::word_count == 64, "a bit for each word in the head of a change");

ChangeQueue::ChangeQueue(std::size_t capacity_bytes, std::shared_ptr<const BoneContent> content)
    : has_reader_(capacity_bytes > 0),
      queue_(has_reader_ ? std::max(capacity_bytes, largest_change_bytes) : 0),
      content_(std::move(content)),
      is_overflowed_(has_reader_ ? content_->brick_of_slot.size() : 0, false) {
    overflowed_.reserve(is_overflowed_.size());
}

void ChangeQueue::push(const BrickChange& change, BrickFractions fractions) noexcept {
    // Once a brick waits to be sent again, its later changes wait with it: order within a brick is kept.
    if (has_overflowed() && is_overflowed_[slot_of(change)]) {
        has_restored_overflowed_ |= change.kind == ChangeKind::restored;
        return;
    }
    if (send(change, fractions)) return;
    overflow_count_.fetch_add(1, std::memory_order_relaxed);
    has_restored_overflowed_ |= change.kind == ChangeKind::restored;
    is_overflowed_[slot_of(change)] = true;
    overflowed_.push_back(slot_of(change));
}

void ChangeQueue::resend_overflowed(const Bone& bone) noexcept {
    while (!overflowed_.empty() && queue_.write_available() >= largest_change_bytes) {
        const std::size_t slot = overflowed_.back();
        overflowed_.pop_back();
        is_overflowed_[slot] = false;
        send({content_->brick_of_slot[slot], VoxelMask().set_all(),
              has_restored_overflowed_ ? ChangeKind::restored : ChangeKind::milled},
             bone.fractions(static_cast<std::int32_t>(slot)));
    }
    if (overflowed_.empty()) has_restored_overflowed_ = false;
}

bool ChangeQueue::send(const BrickChange& change, BrickFractions fractions) noexcept {
    if (!has_reader_) return true;
    Head head{.brick = change.brick, .kind = change.kind};
    std::uint8_t* to = packed_.data() + sizeof head;
    for (std::size_t number = 0; number < VoxelMask::word_count; ++number) {
        // An empty word is overwritten by the next: quicker than a branch that nobody can predict.
        const VoxelMask::Word word = change.voxels.words()[number];
        std::memcpy(to, &word, sizeof word);
        to += word != 0 ? sizeof word : 0;
        head.words |= std::uint64_t{word != 0} << number;
    }
    const std::uint8_t* const first_fraction = to;
    change.voxels.for_each([&](std::size_t voxel) { *to++ = fractions[voxel]; });
    head.fractions = static_cast<std::uint16_t>(to - first_fraction);
    std::memcpy(packed_.data(), &head, sizeof head);

    const auto bytes = static_cast<std::size_t>(to - packed_.data());
    // The consumer sees nothing of it before it sees all.
    return queue_.write_available() >= bytes && queue_.push(packed_.data(), bytes) == bytes;
}

std::size_t ChangeQueue::receive() noexcept {
    Head head;
    queue_.pop(reinterpret_cast<std::uint8_t*>(&head), sizeof head);
    std::array<VoxelMask::Word, VoxelMask::word_count> words;
    std::size_t bytes = sizeof head;
    bytes += queue_.pop(reinterpret_cast<std::uint8_t*>(words.data()),
                        static_cast<std::size_t>(std::popcount(head.words)) * sizeof words[0]);
    received_ = {.brick = head.brick, .kind = head.kind};
    std::size_t next = 0;
    for (std::uint64_t rest = head.words; rest != 0; rest &= rest - 1)
        received_.voxels.set_word(static_cast<std::size_t>(std::countr_zero(rest)), words[next++]);
    ByteBrick packed;
    bytes += queue_.pop(packed.data(), head.fractions);
    next = 0;
    received_.voxels.for_each([&](std::size_t voxel) { received_fractions_[voxel] = packed[next++]; });
    return bytes;
}

}  // namespace osteomill
