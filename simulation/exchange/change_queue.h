// Ordered queue of changes from the milling loop to the thread that keeps a copy of the bone
// (haptic_server/streaming/live_session.h takes them).
//
// It is a ring of bytes, and a change takes no more of it than it says: 16 bytes for the brick and for which
// words of the mask hold a voxel, 8 for each of these words, one for the fraction of each voxel.
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/bone/brick_change.h"

namespace osteomill {

/// One producer (milling loop), one consumer (streaming loop), no locks. When the queue is full no bone is
/// lost: the brick is remembered and sent whole, as it then is, by resend_overflowed(). Each overflow is
/// counted.
class ChangeQueue final : public ChangeSink {
    /// The head of a change in the ring.
    struct Head {
        BrickIndex brick = 0;
        std::uint16_t fractions = 0;  ///< how many follow, after the words
        ChangeKind kind = ChangeKind::milled;
        std::uint64_t words = 0;  ///< bit n: word n of the mask follows
    };

  public:
    /// The size of a whole brick's change.
    static constexpr std::size_t largest_change_bytes =
        sizeof(Head) + brick_voxel_count / 8 + brick_voxel_count;

    /// Room for `capacity_bytes` of changes to the bone of this content, and for a whole brick at least; 0:
    /// nobody reads them, and it keeps none.
    ChangeQueue(std::size_t capacity_bytes, std::shared_ptr<const BoneContent> content);

    /// Producer only. The change's brick must be stored. Real-time safe.
    void push(const BrickChange& change, BrickFractions fractions) noexcept override;
    /// Producer only, after each step. Sends bricks that overflowed before, as far as they fit. Real-time
    /// safe.
    void resend_overflowed(const Bone& bone) noexcept;
    /// Producer only. True while some brick waits to be sent again.
    bool has_overflowed() const noexcept { return !overflowed_.empty(); }

    /// Producer only, for callers that can wait: false, and nothing is queued, if it does not fit. Real-time
    /// safe.
    [[nodiscard]] bool try_push(const BrickChange& change, BrickFractions fractions) noexcept {
        return send(change, fractions);
    }

    /// Consumer only. Calls `consume(const BrickChange&, BrickFractions)` for every change that is there now,
    /// or the first `most` of them; returns how many.
    template <typename Consume>
    std::size_t consume_all(Consume&& consume, std::size_t most = ~std::size_t{0}) {
        std::size_t count = 0;
        for (std::size_t bytes = queue_.read_available(); bytes > 0 && count < most; ++count) {
            bytes -= receive();
            consume(std::as_const(received_), BrickFractions(received_fractions_));
        }
        return count;
    }

    /// Any thread. Changes that found the queue full.
    std::uint64_t overflow_count() const noexcept { return overflow_count_.load(std::memory_order_relaxed); }

  private:
    std::size_t slot_of(const BrickChange& change) const noexcept {
        return static_cast<std::size_t>(content_->slot_of_brick.find(change.brick));
    }
    /// All or nothing; false if it does not fit.
    bool send(const BrickChange& change, BrickFractions fractions) noexcept;
    /// Takes the next change, which is there. Returns its bytes.
    std::size_t receive() noexcept;

    bool has_reader_;
    boost::lockfree::spsc_queue<std::uint8_t> queue_;

    // Producer only.
    std::shared_ptr<const BoneContent> content_;
    std::array<std::uint8_t, largest_change_bytes> packed_;  // scratch
    std::vector<std::size_t> overflowed_;                    // slots; reserved for every one
    std::vector<bool> is_overflowed_;                        // by slot
    bool has_restored_overflowed_ = false;                   // one of them, since all was sent last

    // Consumer only.
    BrickChange received_;
    ByteBrick received_fractions_{};

    std::atomic<std::uint64_t> overflow_count_{0};
};

}  // namespace osteomill
