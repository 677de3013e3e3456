#include "simulation/coupling/passivity_control.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill {

PassivityControl::PassivityControl(std::unique_ptr<Coupling> base, const CouplingOptions& options)
    : base_(std::move(base)),
      position_(options.device.position_resolution_mm),
      apparent_mass_kg_(options.device.apparent_mass_kg) {}

PassivityControl::PassivityControl(const PassivityControl& other)
    : base_(other.base_->copy()),
      position_(other.position_),
      apparent_mass_kg_(other.apparent_mass_kg_),
      has_last_(other.has_last_),
      last_position_mm_(other.last_position_mm_),
      last_force_n_(other.last_force_n_),
      taken_mj_(other.taken_mj_) {}

void PassivityControl::reset() noexcept {
    base_->reset();
    position_.reset();
    has_last_ = false;
    taken_mj_ = 0.0;
}

CouplingOutput PassivityControl::tick(const HandState& hand, const MillingResult& latest) noexcept {
    const glm::dvec3 position_mm = position_.update(hand.pose.position_mm, hand.tick_s);
    const glm::dvec3 step_mm = has_last_ ? position_mm - last_position_mm_ : glm::dvec3(0.0);
    if (has_last_) taken_mj_ -= glm::dot(last_force_n_, step_mm);

    CouplingOutput output = base_->tick(hand, latest);
    const double step_mm2 = glm::dot(step_mm, step_mm);
    if (output.force_n == glm::dvec3(0.0)) {
        taken_mj_ = std::min(taken_mj_, 0.0);
    } else if (taken_mj_ < 0.0 && step_mm2 > 0.0) {
        // mJ s / mm^2 = N s/mm, and so is kg/s / 1000.
        const double most_n_s_per_mm = 1e-3 * apparent_mass_kg_ / (2.0 * hand.tick_s);
        const double alpha_n_s_per_mm = std::min(-taken_mj_ * hand.tick_s / step_mm2, most_n_s_per_mm);
        output.force_n -= alpha_n_s_per_mm / hand.tick_s * step_mm;
    }

    last_position_mm_ = position_mm;
    last_force_n_ = output.force_n;
    has_last_ = true;
    return output;
}

}  // namespace osteomill
