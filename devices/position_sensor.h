// An arm's motion as its driver knows it: position in whole encoder steps and, from those, a velocity.
//
//     v <- v + dt / (tau + dt) ((x_k - x_{k-1}) / dt - v),   x quantised, tau = 5 ms
//
// One step of 0.055 mm in 1 ms is 55 mm/s; the filter makes that 9.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

class PositionSensor {
  public:
    static constexpr double velocity_filter_s = 0.005;

    /// `resolution_mm` 0 reads exactly.
    explicit PositionSensor(double resolution_mm) : resolution_mm_(resolution_mm) {}

    /// Takes a reading `elapsed_s` after the last; the first reading has velocity zero. Real-time safe.
    void read(const glm::dvec3& true_position_mm, double elapsed_s) noexcept {
        const glm::dvec3 previous_mm = position_mm_;
        position_mm_ = resolution_mm_ > 0.0 ? resolution_mm_ * glm::round(true_position_mm / resolution_mm_)
                                            : true_position_mm;
        if (has_read_ && elapsed_s > 0.0) {
            velocity_mm_per_s_ += elapsed_s / (velocity_filter_s + elapsed_s) *
                                  ((position_mm_ - previous_mm) / elapsed_s - velocity_mm_per_s_);
        }
        has_read_ = true;
    }

    const glm::dvec3& position_mm() const { return position_mm_; }
    const glm::dvec3& velocity_mm_per_s() const { return velocity_mm_per_s_; }

  private:
    double resolution_mm_;
    bool has_read_ = false;
    glm::dvec3 position_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
};

/// Clutch: the hand moves while the tool stays, like lifting a mouse. While engaged the position does not
/// follow; afterwards it continues from its last value.
class Clutch {
  public:
    /// The tool's position for this position of the hand, both mm. Real-time safe.
    glm::dvec3 position_mm(const glm::dvec3& hand_mm, bool is_engaged) noexcept {
        if (is_engaged) offset_mm_ = tool_mm_ - hand_mm;
        tool_mm_ = hand_mm + offset_mm_;
        return tool_mm_;
    }

  private:
    glm::dvec3 offset_mm_{0.0};
    glm::dvec3 tool_mm_{0.0};
};

}  // namespace osteomill
