// Fade-out of the force sent to an arm, which never ends in one step: when the loop's force becomes invalid
// (the arm is lost, not able, in the clutch; the loop stands still), the last force shrinks linearly to zero
// within fade_s. The fade-out after a fault and the fade-in are force_guard.h's (simulation/safety).
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <optional>

namespace osteomill {

class FadeOut {
  public:
    /// The promise is 50 ms; a fade shorter than this is felt as a knock.
    static constexpr double fade_s = 0.03;

    /// The force to send at `now_s` (any clock that never decreases): `wanted_n` if there is one, or the
    /// rest of the one before. Real-time safe.
    glm::dvec3 next(const std::optional<glm::dvec3>& wanted_n, double now_s) noexcept {
        if (wanted_n) {
            ended_s_.reset();
            return last_n_ = sent_n_ = *wanted_n;
        }
        if (!ended_s_) ended_s_ = now_s;
        return sent_n_ = last_n_ * std::clamp(1.0 - (now_s - *ended_s_) / fade_s, 0.0, 1.0);
    }

    /// Whether the last sent force is not zero.
    bool is_felt() const { return sent_n_ != glm::dvec3(0.0); }

  private:
    glm::dvec3 last_n_{0.0};  // as wanted
    glm::dvec3 sent_n_{0.0};
    std::optional<double> ended_s_;
};

}  // namespace osteomill
