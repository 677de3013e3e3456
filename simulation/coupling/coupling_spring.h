// Spring and damper between the hand and a burr that is not rigidly the device.
//
//     F_hand = -K_c (x - p) - B_c (v - w)      x the hand, p the burr
//     v, w: dx/dt and dp/dt through first-order filters of tau_x and tau_p
//
// K_c and B_c are the arm's (arm_spring.h). On a wall the burr stands still and B_c alone keeps the arm
// stable. 5 N s/m through 1 ms hold a wall of 1.7 N/mm on a bare arm with one tick of delay to spare;
// docs/coupling.md has the table of stable walls, and the effects of encoder steps and friction.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/coupling/contact_solve.h"
#include "simulation/device/arm_spring.h"

namespace osteomill {

class CouplingSpring {
  public:
    static constexpr double hand_filter_s = ArmSpring::hand_filter_s;

    /// `burr_filter_s` is tau_p.
    CouplingSpring(const PatientLimits& arm, double burr_filter_s)
        : stiffness_n_per_mm_(arm.max_stiffness_n_per_mm),
          damping_n_s_per_mm_(arm.damping_n_s_per_mm),
          burr_filter_s_(burr_filter_s) {}

    /// Slack and at rest, both ends at `position_mm`.
    void place(const glm::dvec3& position_mm) noexcept {
        hand_ = burr_ = {position_mm, glm::dvec3(0.0)};
        on_hand_n_ = glm::dvec3(0.0);
    }

    /// Takes the hand's position after a tick of `tick_s` > 0, and returns the pull of spring and damper on
    /// the burr as a function of its step in this tick. Real-time safe.
    LinearPull follow_hand(const glm::dvec3& hand_mm, double tick_s) noexcept {
        hand_.follow(hand_mm, tick_s, hand_filter_s);
        const double share = share_of_tick(tick_s, burr_filter_s_);
        return {stiffness_n_per_mm_ * (hand_mm - burr_.position_mm) +
                    damping_n_s_per_mm_ * (hand_.velocity_mm_per_s - (1.0 - share) * burr_.velocity_mm_per_s),
                stiffness_n_per_mm_ + damping_n_s_per_mm_ * share / tick_s};
    }

    /// Takes where the burr is after the same tick, and returns the force on the hand. Real-time safe.
    glm::dvec3 follow_burr(const glm::dvec3& burr_mm, double tick_s) noexcept {
        burr_.follow(burr_mm, tick_s, burr_filter_s_);
        if (hand_.position_mm == burr_mm) {
            // Out of contact the hand does not feel the filters' memory, but no force ends within one tick.
            burr_ = hand_;
            const double before_n = glm::length(on_hand_n_);
            return on_hand_n_ *=
                   before_n > ArmSpring::felt_jump_n ? 1.0 - ArmSpring::felt_jump_n / before_n : 0.0;
        }
        return on_hand_n_ = -stiffness_n_per_mm_ * (hand_.position_mm - burr_mm) -
                            damping_n_s_per_mm_ * (hand_.velocity_mm_per_s - burr_.velocity_mm_per_s);
    }

  private:
    static double share_of_tick(double tick_s, double filter_s) { return tick_s / (filter_s + tick_s); }

    struct End {
        glm::dvec3 position_mm{0.0};
        glm::dvec3 velocity_mm_per_s{0.0};

        void follow(const glm::dvec3& to_mm, double tick_s, double filter_s) noexcept {
            velocity_mm_per_s +=
                share_of_tick(tick_s, filter_s) * ((to_mm - position_mm) / tick_s - velocity_mm_per_s);
            position_mm = to_mm;
        }
    };

    double stiffness_n_per_mm_;
    double damping_n_s_per_mm_;
    double burr_filter_s_;
    End hand_;
    End burr_;
    glm::dvec3 on_hand_n_{0.0};  // in the last tick
};

}  // namespace osteomill
