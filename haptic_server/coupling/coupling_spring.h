// Spring and damper between the hand and a burr that is not rigidly the device.
//
//     F_hand = -K_c (x - p) - B_c (v - w)      x the hand, p the burr
//     v, w: dx/dt and dp/dt through first-order filters of tau_x and tau_p
//
// K_c is the spring that the device claims to render. B_c is what keeps it stable where the burr stands
// still, on a wall, and nothing else damps the arm: a held spring force leaks K_c T / 2, a further tick
// between reading and force K_c T, so 2.3 N s/m of the arm's 0.5 for K_c = 1.5 N/mm, which B_c must make up
// for although its own force comes late by filter and delay. Linearised, the stiffest wall that holds, N/m:
//
//     B_c, tau_x           bare arm, 0.5 N s/m     light grip              firm grip
//     and extra ticks       0     1     2           0     1     2           0     1     2
//     2 N s/m, 3 ms      2760  1090   700        6330  2390  1460       12500  4500  2630
//     4 N s/m, 3 ms      3890  1540   940        8050  3050  1960       15200  5470  3360
//     4 N s/m, 1 ms      6200  2270  1350       10600  3720  2240       17500  5920  3560
//
// (light: 145 g, 2.1 N s/m, 100 N/m; firm: 545 g, 5.1 N s/m, 300 N/m). So 1.5 N/mm holds with one more tick
// of delay at 66 % of the edge on the bare arm; two more would want less than 1.35. A spring stretched to
// where the observer predicts the hand one tick ahead is K_c T = 1.5 N s/m more of damping and nothing else.
//
// With encoder steps the damping is as good as the speed that they let one see (position_observer.h). With
// the arm's friction (0.26 N) it comes to rest on the wall in each case of the first two columns; without
// friction, which no arm is, it hunts about the steps: 0.1 to 0.15 N rms, 0.28 N one tick late on the bare
// arm. An observer that believes a turn sooner halves that, but more of the encoder's grain is then felt in
// every cut.
//
// On a wall the burr has no speed, and the table does not know tau_p.
#pragma once

#include <glm/vec3.hpp>

namespace osteomill {

class CouplingSpring {
  public:
    static constexpr double damping_n_s_per_mm = 0.004;
    static constexpr double hand_filter_s = 0.001;

    /// `burr_filter_s` is tau_p.
    CouplingSpring(double stiffness_n_per_mm, double burr_filter_s)
        : stiffness_n_per_mm_(stiffness_n_per_mm), burr_filter_s_(burr_filter_s) {}

    /// Slack and at rest, both ends at `position_mm`.
    void place(const glm::dvec3& position_mm) noexcept { hand_ = burr_ = {position_mm, glm::dvec3(0.0)}; }

    /// Force on the hand after a tick of `tick_s` > 0 that brought both ends here. Real-time safe.
    glm::dvec3 stretch(const glm::dvec3& hand_mm, const glm::dvec3& burr_mm, double tick_s) noexcept {
        hand_.follow(hand_mm, tick_s, hand_filter_s);
        burr_.follow(burr_mm, tick_s, burr_filter_s_);
        // Out of contact the spring is slack at once; what the filters remember must not be felt in air.
        if (hand_mm == burr_mm) burr_ = hand_;
        return -stiffness_n_per_mm_ * (hand_mm - burr_mm) -
               damping_n_s_per_mm * (hand_.velocity_mm_per_s - burr_.velocity_mm_per_s);
    }

  private:
    struct End {
        glm::dvec3 position_mm{0.0};
        glm::dvec3 velocity_mm_per_s{0.0};

        void follow(const glm::dvec3& to_mm, double tick_s, double filter_s) noexcept {
            const double share = tick_s / (filter_s + tick_s);
            velocity_mm_per_s += share * ((to_mm - position_mm) / tick_s - velocity_mm_per_s);
            position_mm = to_mm;
        }
    };

    double stiffness_n_per_mm_;
    double burr_filter_s_;
    End hand_;
    End burr_;
};

}  // namespace osteomill
