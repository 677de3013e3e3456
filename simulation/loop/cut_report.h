// Report of the cut for the sound, fifty times a second: force, ripple within the tooth period, stiffness of
// the bone, and the motor's speed under load. The milling loop makes it from the results that it publishes
// anyway; it affects no force.
//
// A patch p of the burr's surface that touches bone and moves toward it cuts f_p, as an edge rubs there and
// takes its chip (Engagement). An edge passes its azimuth psi_p once a tooth period, so that the force within
// the period is, in its first harmonic,
//
//     c = 2 sum_p f_p cos(N psi_p),    s = 2 sum_p f_p sin(N psi_p),    amplitude^2 = |c|^2 + |s|^2
//
// and the torque on the spindle is sum_p r_p f_p . e_psi, r_p the patch's distance from the axis. For a head
// that is no ball, r_p is that of a ball of its diameter, which is good enough for the ear.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "common/scene/burr.h"
#include "common/scene/scene.h"
#include "common/session/tool_state.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

class CutReport {
  public:
    static constexpr double period_s = 0.02;
    /// Hard bone yields one level of a voxel at a time: the force is averaged over this time, or the sound
    /// would stutter under even pressure.
    static constexpr double remembers_s = 0.04;
    /// Less is none.
    static constexpr double least_force_n = 0.01;

    CutReport(std::vector<Burr> burrs, std::optional<Motor> motor);

    /// A result that stands for `elapsed_s`. Real-time safe, as all that follows.
    void add(const MillingResult& result, double elapsed_s) noexcept;
    /// Whether a report's period is over.
    bool is_due() const noexcept;
    /// The cut of the period that ends with `latest`, in which the spindle turned at `speed_share` of the
    /// burr's speed; nothing if nothing was cut. The next period begins.
    std::optional<CutState> take(const MillingResult& latest, double speed_share) noexcept;

  private:
    /// Sums over the patches that cut.
    struct Sums {
        glm::dvec3 cosine_n{0.0};
        glm::dvec3 sine_n{0.0};
        double torque_n_mm = 0.0;
        double chips_n = 0.0;            // sum of magnitudes
        double stiffness_chips_n = 0.0;  // sum of those times the patch's stiffness

        double ripple_n() const noexcept;
        double relative_stiffness() const noexcept;
    };

    void look_at(const MillingResult& latest, double speed_share, const glm::dvec3& feed_mm_per_s) noexcept;
    Sums sum(const MillingResult& latest, const Burr& burr, const glm::dvec3& feed_mm_per_s) const noexcept;

    TurningBurrs burrs_;
    std::optional<Motor> motor_;
    CutState last_;
    double elapsed_s_ = 0.0;
    double impulse_n_s_ = 0.0;   // in the period
    double force_n_ = 0.0;       // as remembered
    bool has_position_ = false;  // the burr's, at the end of the last period
    glm::dvec3 position_mm_{0.0};
};

}  // namespace osteomill
