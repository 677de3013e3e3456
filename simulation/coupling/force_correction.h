// Correction of a predicted cutting force by the bone that the carve then really removed. The engagement
// map's patches are coarse for a shallow cut, and it sees a rim of bone as in contact a little early or late:
// the force comes out a few per cent too long or too short and a degree off its direction, and a soft hand
// swings on that. The milling model's force, which comes from the removed voxels themselves, does not have
// the error. The gain G that makes the two agree is followed slowly, but while a contact is young the map is
// off by most and changes fastest: the window is a tenth of the contact's age, up to 30 ms. The gain knows no
// direction but the spindle a:
// a stretch and a turn across it, a stretch along it,
//
//     G = re (1 - a a^T) + im [a]x + along a a^T
//     re    = <m . p>_across / <p . p>_across      p the predicted force without G, m the model's,
//     im    = <a . (p x m)>  / <p . p>_across      <> means over a sliding window
//     along = <m_a p_a> / <p_a p_a>
//
// Impulses are compared, not forces: at 300 Hz one of the model's steps takes three haptic ticks, the next
// takes four. re and along stay within [0.5, 1.5], im within +-0.3; while there is little force to compare, G
// returns to 1. A gain learnt in one contact does not fit the next: after 20 ms in air it is forgotten.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

class ForceCorrection {
  public:
    /// Force that the proxy felt in a tick of `tick_s`, with the gain in it.
    void add_prediction(const glm::dvec3& force_n, double tick_s) noexcept {
        predicted_n_s_ += ungain_ * force_n * tick_s;
        window_s_ += tick_s;
    }

    /// The milling model's mean force over its step that ended at `time_s` (session time), for the bone
    /// removed on the proxy's path since the last call; `axis` is the spindle (unit), patient axes. The first
    /// call after a reset only tells when the next step began. Real-time safe.
    void compare(const glm::dvec3& model_n, double time_s, const glm::dvec3& axis) noexcept {
        const double step_s = time_s - time_s_;
        const double window_s = window_s_;
        const glm::dvec3 predicted_n_s = predicted_n_s_;
        time_s_ = time_s;
        window_s_ = 0.0;
        predicted_n_s_ = glm::dvec3(0.0);
        if (window_s <= 0.0 || step_s > longest_step_s) return;

        const glm::dvec3 p = predicted_n_s / window_s;
        const glm::dvec3 m = model_n * (step_s / window_s);
        const double p_along = glm::dot(p, axis);
        const double m_along = glm::dot(m, axis);
        if (glm::dot(p, p) + glm::dot(m, m) < quiet_n2) {
            air_s_ += window_s;
            if (air_s_ > longest_air_s) forget();
            return;
        }
        air_s_ = 0.0;
        age_s_ += window_s;
        const double share = window_s / (std::min(memory_s, memory_by_age * age_s_) + window_s);
        const auto follow = [share](double& mean, double now) { mean += share * (now - mean); };
        follow(agreement_across_, glm::dot(p, m) - p_along * m_along);
        follow(turn_across_, glm::dot(axis, glm::cross(p, m)));
        follow(power_across_, glm::dot(p, p) - p_along * p_along);
        follow(agreement_along_, p_along * m_along);
        follow(power_along_, p_along * p_along);

        const double re = stretch(agreement_across_, power_across_);
        const double along = stretch(agreement_along_, power_along_);
        const double im = std::clamp(turn_across_ / (power_across_ + quiet_n2), -most_turn, most_turn);
        const glm::dmat3 turn(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
        gain_ = glm::dmat3(re) + (along - re) * glm::outerProduct(axis, axis) + im * turn;
        ungain_ = glm::inverse(gain_);
    }

    void reset() noexcept { *this = ForceCorrection{}; }
    const glm::dmat3& gain() const noexcept { return gain_; }

    static constexpr double memory_s = 0.03;  ///< of a contact that lasts
    static constexpr double memory_by_age = 0.1;
    /// Below about the square root of this force the gain means nothing and tends to 1.
    static constexpr double quiet_n2 = 1e-6;
    static constexpr double most_turn = 0.3;
    /// Longer than any step of the milling loop: there was a pause.
    static constexpr double longest_step_s = 0.1;
    static constexpr double longest_air_s = 0.02;

  private:
    void forget() noexcept {
        const double time_s = time_s_;
        reset();
        time_s_ = time_s;
    }

    static double stretch(double agreement, double power) noexcept {
        return std::clamp((agreement + quiet_n2) / (power + quiet_n2), 0.5, 1.5);
    }

    glm::dvec3 predicted_n_s_{0.0};
    double window_s_ = 0.0;
    double time_s_ = -1.0;  // end of the model's last step
    double air_s_ = 0.0;    // since there was a force to compare
    double age_s_ = 0.0;    // of the contact: time with a force to compare
    double agreement_across_ = 0.0;
    double turn_across_ = 0.0;
    double power_across_ = 0.0;
    double agreement_along_ = 0.0;
    double power_along_ = 0.0;
    glm::dmat3 gain_{1.0};
    glm::dmat3 ungain_{1.0};
};

}  // namespace osteomill
