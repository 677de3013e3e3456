// Three hands enter bone on the same line: one whose burr is rigidly the hand, without any loop's delay (the
// exact answer), one with an ideal spring, and one with a coupling of the program on the map of the milling
// model.
//
//     exact      m dv/dt = hand - b v - dW/dt, backward Euler in steps of 20 us
//     ideal      the coupling's own spring, damper and filters (coupling_spring.h), each millisecond in
//                balance with the bone's impulse: K (x - p) + B (v - w) = (W(p') - W(p)) / T
//     coupling   the program's, milling and haptic loop at 1 kHz in turns
//
// So the ideal one is the best that a coupling with that spring can do, and its distance from the coupling is
// what the engagement map loses. A hand is led along the line at its speed (prescribed), or a firm hand holds
// the arm, which is guided along the line, and means to go so. No encoder steps, no Coulomb friction, no
// limit of the arm's force. Only the coupling's burr may be pushed aside: in a plunge nothing pushes it.
#pragma once

#include <string>
#include <vector>

#include "studies/stability/onset/onset.h"

namespace osteomill::study {

struct OnsetHand {
    std::string coupling = "implicit";  ///< as of --coupling
    bool feed_forward = false;          ///< of bone's change, of a coupling that has one
    double stiffness_n_per_mm = 1.5;    ///< of the spring, above 0
    double damping_n_s_per_mm = 0.004;
    bool is_guided = false;  ///< by a firm hand; else prescribed
};

/// Forces on the hand, a tick a millisecond, patient axes.
struct OnsetRun {
    std::vector<glm::dvec3> exact_n;
    std::vector<glm::dvec3> ideal_n;
    std::vector<glm::dvec3> felt_n;  ///< with the coupling
};

/// Until a prescribed hand stops, or a tenth of a second after a guided one means to. Throws
/// std::invalid_argument for an unknown coupling, a spring that is none, a speed or way that is not above 0,
/// and as ImpulseByWay does.
OnsetRun run_onset(const Onset& onset, const OnsetHand& hand);

struct OnsetPeak {
    double peak_n = 0.0;   ///< largest mean over 5 ms
    double half_ms = 0.0;  ///< when that mean first exceeds half of `of_peak_n`; the run's length if never
};

OnsetPeak peak_of(const std::vector<glm::dvec3>& forces_n, double of_peak_n);

}  // namespace osteomill::study
