// Limits of a hand on targets that come by message: each within reach of the burr, and their path no longer
// than a hand could have gone.
//
//     path since time 0  <=  room_mm + fastest_hand_mm_per_s * time,    room_mm = 2 longest_reach_mm
//
// The margin allows messages that come late and in a burst: crossing the burr's reach from one side to the
// other once is allowed.
#pragma once

#include <atomic>
#include <glm/vec3.hpp>

#include "common/session/operator_command.h"

namespace osteomill {

class TargetLimit {
  public:
    static constexpr double room_mm = 2.0 * longest_reach_mm;

    /// The path begins at `start_mm` (device space, as all of these: a hand holds the arm).
    explicit TargetLimit(const glm::dvec3& start_mm) : target_mm_(start_mm) {}

    /// The path goes on from here: the operator was away.
    void resume_at(const glm::dvec3& target_mm) noexcept { target_mm_ = target_mm; }

    /// `wanted_mm` (finite), or the nearest allowed position. `now_s`: session time, never decreases.
    /// Real-time safe.
    glm::dvec3 limited(const glm::dvec3& wanted_mm, const glm::dvec3& burr_mm, double now_s) noexcept;

    /// The targets clamped so far, one line with static lifetime; empty if none. Any thread.
    const char* notice() const noexcept;

  private:
    glm::dvec3 target_mm_;
    double room_left_mm_ = room_mm;
    double limited_s_ = 0.0;
    std::atomic<bool> was_out_of_reach_{false};
    std::atomic<bool> was_too_fast_{false};
};

}  // namespace osteomill
