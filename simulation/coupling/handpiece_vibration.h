// Vibration of a cutting handpiece: the part of the force within a turn of the spindle that an arm can
// render, to be added to a coupling's mean over a tooth period.
//
// Two sines, each felt only up to highest_hz; nothing above is rendered, and so nothing is aliased. From the
// patches p of the engagement map (engagement.h) that cut, with theta the angle of an edge, N edges, n
// revolutions a second, the burr's feed v and x, y across the spindle:
//
//     once a turn, at n:     F = sum of C_p (n_p . d) w        d = x cos theta + y sin theta
//                            w = 2 e sin(pi / N) N n
//     once a tooth, at N n:  F = 2 sum of f_p cos N (theta - psi_p)
//                            f_p = C_p (n_p . v) + edge_p
//
// The first is run-out. The axis of an eccentric burr is e, half the run-out, off the spindle's, so that a
// tooth takes a chip thicker than the mean by e (cos phi - cos(phi - 2 pi / N)) (Kline and DeVor 1983, Int J
// Mach Tool Des Res 23:123), at most 2 e sin(pi / N), and half a turn later the chip is as much thinner. To
// the bone that is a feed w that turns with the spindle. Edges rub alike on thin chips and thick ones. The
// second: the mean force f_p of a patch comes in pulses, when an edge passes its azimuth psi_p.
//
// An edge that has come out of the cut takes no chip. So neither sine is larger than the mean force of the
// patches that it comes from, of chips alone for the first, and the force does not turn round. Left out:
// harmonics (of a tooth period that is longer than 7 ms, or of edges that leave the cut), and edges that
// leave the cut and do not rub meanwhile.
//
// The sum stays within the margin that the mean leaves below the device's limit, and within most of the
// allowed rate of change; otherwise the safety monitor would clip it, which makes other frequencies. At 167
// Hz and 1000 N/s that is 0.76 N.
//
// Energy. A real hand is shaken by the spindle's motor, which is not modelled, and a hand damps vibration. So
// the vibration may give the hand only energy that the hand has spent: a store counts half the work of the
// burr on the bone, less the work of the vibration by the device's readings, up to most_store_mj. The
// vibration is never stronger than the store could pay for a hand that moves along with it at
// fastest_mm_per_s (after a faster motion it is silent until the debt is paid). So a cut takes energy from
// the hand on any path. The factor of one half is there because a coupling may take less from the hand than
// the bone takes from the burr: with encoder steps, a sampled spring returns more than was put in.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/burr.h"
#include "common/scene/scene.h"
#include "simulation/coupling/coupling.h"

namespace osteomill {

struct VibrationLimits {
    double max_force_n = 0.0;       ///< of the device
    double max_slew_n_per_s = 0.0;  ///< of the force on the hand
    ArmScale scale{};
};

class HandpieceVibration {
  public:
    static constexpr double highest_hz = 300.0;
    /// Time constant with which it follows the cut: longer than a tick, so that nothing clicks; too short for
    /// a hand to notice.
    static constexpr double follows_s = 0.01;
    static constexpr double share_of_slew = 0.8;
    static constexpr double most_store_mj = 1.0;  // at the arm, as the speed of the hand
    static constexpr double share_of_work = 0.5;
    /// Faster than a hand that cuts; a step of an arm's encoder within a tick is half as long.
    static constexpr double fastest_mm_per_s = 100.0;
    /// An amplitude below this is none.
    static constexpr double silent_n = 1e-4;

    /// `burrs`: the scene's.
    HandpieceVibration(std::vector<Burr> burrs, const VibrationLimits& limits);

    /// The force to add to the coupling's `mean_force_n` in this tick: zero with the spindle off, or while
    /// the force is not felt as requested (`is_felt`). Real-time safe.
    glm::dvec3 tick(const HandState& hand, const MillingResult& latest, const glm::dvec3& mean_force_n,
                    bool is_felt) noexcept;

    /// Energy that it may still give to the hand, in patient space; a debt if below 0.
    double store_mj() const noexcept { return store_mj_; }

  private:
    /// cosine_n cos(angle) + sine_n sin(angle), N, patient axes: an ellipse.
    struct Sine {
        glm::dvec3 cosine_n{0.0};
        glm::dvec3 sine_n{0.0};

        glm::dvec3 at(double angle_rad) const noexcept;
        /// Half its major axis.
        double amplitude_n() const noexcept;
        bool is_finite() const noexcept;
        void limit(double amplitude_n) noexcept;
        void follow(const Sine& target, double share) noexcept;
    };

    void follow_hand(const glm::dvec3& hand_mm) noexcept;
    void silence() noexcept;
    void look_at_cut(const MillingResult& latest, const Burr& burr) noexcept;
    /// Sets the sines to aim for. Columns of `frame`: the burr's axes in patient axes.
    void aim(const Engagement& engagement, const glm::dmat3& frame, const Burr& burr) noexcept;
    /// The sines, within all limits.
    glm::dvec3 allowed_n(const Burr& burr, double tick_s, double mean_n) const noexcept;

    TurningBurrs burrs_;
    VibrationLimits limits_;
    double turned_rev_ = 0.0;  // within a turn
    Sine turn_;                // the felt sines, and those that the cut asks for
    Sine turn_target_;
    Sine tooth_;
    Sine tooth_target_;

    bool has_result_ = false;
    std::uint64_t step_ = 0;  // of the result last looked at
    double result_s_ = 0.0;
    glm::dvec3 burr_mm_{0.0};
    glm::dvec3 feed_mm_per_s_{0.0};

    bool has_hand_ = false;
    glm::dvec3 hand_mm_{0.0};
    glm::dvec3 force_n_{0.0};  // last given
    double store_mj_ = 0.0;
};

/// Whether a cut with this burr shakes at a frequency that is rendered.
bool vibrates_in_reach(const Burr& burr) noexcept;

}  // namespace osteomill
