// One tick of an arm that is measured. Device space.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace osteomill {

struct MeasuredTick {
    glm::dvec3 position_mm{0.0};  ///< as it was read
    glm::dvec3 force_n{0.0};      ///< as it was written then, for the tick that follows
};

/// A tick is a millisecond, for all that measures here.
inline constexpr double measuring_tick_s = 0.001;

/// Ticks in their order, in memory that is there from the start. Ticks that were missed are filled in: the
/// force was held, and the reading is the next one's.
class TickRecord {
  public:
    explicit TickRecord(std::size_t most) { ticks_.reserve(most); }

    /// Real-time safe. Past the most, ticks are dropped.
    void add(const glm::dvec3& position_mm, const glm::dvec3& force_n, std::size_t missed) noexcept {
        const glm::dvec3 held_n = ticks_.empty() ? glm::dvec3(0.0) : ticks_.back().force_n;
        for (std::size_t i = 0; i < missed && ticks_.size() < ticks_.capacity(); ++i)
            ticks_.push_back({position_mm, held_n});
        if (ticks_.size() < ticks_.capacity()) ticks_.push_back({position_mm, force_n});
    }

    std::size_t size() const noexcept { return ticks_.size(); }
    /// The ticks from `begin` on.
    std::span<const MeasuredTick> from(std::size_t begin) const noexcept {
        return std::span(ticks_).subspan(begin < ticks_.size() ? begin : ticks_.size());
    }

  private:
    std::vector<MeasuredTick> ticks_;
};

}  // namespace osteomill
