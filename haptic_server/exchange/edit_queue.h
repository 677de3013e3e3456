// The ordered queue of edits from the milling loop to whoever keeps a copy of the bone.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/bone/edit.h"

namespace osteomill {

/// One producer (milling loop), one consumer (streaming loop), no locks. When the queue is full no bone is
/// lost: the brick is remembered and its rows are sent again, as they then are, by resend_overflowed(). Each
/// overflow is counted.
class EditQueue final : public EditSink {
  public:
    /// Room for `capacity` runs of edits to the bone of this content.
    EditQueue(std::size_t capacity, std::shared_ptr<const BoneContent> content);

    /// Producer only. The run's brick must be stored. Real-time safe.
    void push(const EditRun& run) noexcept override;
    /// Producer only, after each step. Sends bricks that overflowed before, as far as there is room.
    /// Real-time safe.
    void resend_overflowed(const Bone& bone) noexcept;
    /// Producer only. True while some brick waits to be sent again.
    bool has_overflowed() const noexcept { return !overflowed_.empty(); }

    /// Consumer only. Calls `consume(const EditRun&)` for every run that is there now; returns how many.
    template <typename Consume>
    std::size_t consume_all(Consume&& consume) {
        return queue_.consume_all(std::forward<Consume>(consume));
    }

    /// Any thread. Runs that found the queue full.
    std::uint64_t overflow_count() const noexcept { return overflow_count_.load(std::memory_order_relaxed); }

  private:
    std::size_t slot_of(const EditRun& run) const noexcept {
        return static_cast<std::size_t>(content_->slot_of_brick.find(run.brick));
    }

    boost::lockfree::spsc_queue<EditRun> queue_;
    std::shared_ptr<const BoneContent> content_;
    std::vector<std::size_t> overflowed_;  // producer only; slots; reserved for every one
    std::vector<bool> is_overflowed_;      // producer only; by slot
    std::atomic<std::uint64_t> overflow_count_{0};
};

}  // namespace osteomill
