// Corrects a predicted cutting force by what the carve then really removed. The engagement map sees a rim of
// bone as in contact a little early or late (a tenth of a voxel matters at shallow depths); the milling
// model's force, which comes from the removed voxels themselves, does not. The gain g that makes them agree
// is followed slowly:
//
//     g = <F_model . F_predicted> / <F_predicted . F_predicted>,   means over a sliding window, F_predicted
//     without g
//
// and stays within [0.5, 1.5]; where there is little force to compare, it returns to 1.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

class ForceCorrection {
  public:
    /// Force that the proxy felt in a tick of `tick_s`, with the gain in it.
    void add_prediction(const glm::dvec3& force_n, double tick_s) noexcept {
        predicted_impulse_ += force_n / gain_ * tick_s;
        window_s_ += tick_s;
    }

    /// The milling model's force for the bone removed on the proxy's way since the last call. Real-time safe.
    void compare(const glm::dvec3& model_force_n) noexcept {
        if (window_s_ <= 0.0) return;
        const glm::dvec3 predicted_n = predicted_impulse_ / window_s_;
        const double share = window_s_ / (memory_s + window_s_);
        agreement_ += share * (glm::dot(model_force_n, predicted_n) - agreement_);
        power_ += share * (glm::dot(predicted_n, predicted_n) - power_);
        gain_ = std::clamp((agreement_ + quiet_n2) / (power_ + quiet_n2), 0.5, 1.5);
        predicted_impulse_ = glm::dvec3(0.0);
        window_s_ = 0.0;
    }

    void reset() noexcept { *this = ForceCorrection{}; }
    double gain() const noexcept { return gain_; }

    static constexpr double memory_s = 0.1;
    /// Below about the square root of this force the gain means nothing and tends to 1.
    static constexpr double quiet_n2 = 1e-4;

  private:
    glm::dvec3 predicted_impulse_{0.0};
    double window_s_ = 0.0;
    double agreement_ = 0.0;
    double power_ = 0.0;
    double gain_ = 1.0;
};

}  // namespace osteomill
