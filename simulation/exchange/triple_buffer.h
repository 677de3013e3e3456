// Triple buffer: the latest value goes from one thread to another without locks. The writer never waits, the
// reader never sees a half-written value, values in between are skipped.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "simulation/exchange/copiable_atomic.h"

namespace osteomill {

/// One writer thread, one reader thread. Values are written in place, so large ones cost no copy. To be
/// copied while neither is at it.
template <typename T>
class TripleBuffer {
  public:
    TripleBuffer() = default;
    /// `first`: the value that the reader finds before anything is published; back() holds the same.
    explicit TripleBuffer(const T& first) : values_{first, first, first} {}

    /// Writer only. The value to fill; it holds that of three publications ago.
    T& back() noexcept { return values_[back_]; }
    /// Writer only. Makes back() the latest value. Real-time safe.
    void publish() noexcept {
        back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index_mask;
    }

    /// Reader only. Takes over the latest value, if there is a newer one; says whether there was. Real-time
    /// safe.
    bool refresh() noexcept {
        if (!(middle_.load(std::memory_order_relaxed) & fresh)) return false;
        front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index_mask;
        return true;
    }
    /// Reader only. The value last taken over; before the first, the buffer's initial one.
    const T& front() const noexcept { return values_[front_]; }

  private:
    static constexpr std::uint8_t fresh = 4;
    static constexpr std::uint8_t index_mask = 3;

    std::array<T, 3> values_{};
    alignas(64) std::uint8_t back_ = 0;                   // writer only
    alignas(64) CopiableAtomic<std::uint8_t> middle_{1};  // shared
    alignas(64) std::uint8_t front_ = 2;                  // reader only
};

}  // namespace osteomill
