// The energy that the device's force has given the hand: the work of each tick's force over the hand's next
// displacement, in the device's space, less the energy that the hand put in. A guard against any law or
// coupling: bone takes energy from a hand and gives none, except for the energy stored in its spring.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

class EnergyMeter {
  public:
    /// Over which lately_mj() sums.
    static constexpr double window_s = 0.1;

    /// The hand was read at `position_mm`, `elapsed_s` after the last call, and felt `force_n` on the way. A
    /// position that is not finite, or a distance above `longest_mm` (a jump, not a hand), counts as no
    /// motion. Real-time safe.
    void add(const glm::dvec3& position_mm, const glm::dvec3& force_n, double elapsed_s,
             double longest_mm) noexcept {
        const glm::dvec3 moved_mm = position_mm - position_mm_;
        const double energy_mj = glm::dot(force_n, moved_mm);
        const bool counts = has_position_ && glm::length(moved_mm) <= longest_mm && std::isfinite(energy_mj);
        has_position_ = std::isfinite(glm::length(position_mm));
        position_mm_ = position_mm;
        put(counts ? energy_mj : 0.0, elapsed_s);
    }

    /// Net, mJ, over the last window_s.
    double lately_mj() const noexcept { return lately_mj_; }
    /// Net, mJ, since the start: the most that it ever was.
    double most_mj() const noexcept { return most_mj_; }

  private:
    struct Tick {
        double energy_mj = 0.0;
        double elapsed_s = 0.0;
    };

    void put(double energy_mj, double elapsed_s) noexcept {
        total_mj_ += energy_mj;
        most_mj_ = std::max(most_mj_, total_mj_);
        ticks_[next_] = {energy_mj, elapsed_s};
        next_ = (next_ + 1) % ticks_.size();
        // Summed anew, from the newest on: a running sum would gather rounding errors all day.
        lately_mj_ = 0.0;
        double age_s = 0.0;
        for (std::size_t i = 1; i <= ticks_.size() && age_s < window_s - 0.5e-3; ++i) {
            const Tick& tick = ticks_[(next_ + ticks_.size() - i) % ticks_.size()];
            lately_mj_ += tick.energy_mj;
            age_s += tick.elapsed_s;
        }
    }

    std::array<Tick, 100> ticks_{};  // a millisecond each: the window
    std::size_t next_ = 0;
    glm::dvec3 position_mm_{0.0};
    bool has_position_ = false;
    double lately_mj_ = 0.0;
    double total_mj_ = 0.0;
    double most_mj_ = 0.0;
};

}  // namespace osteomill
