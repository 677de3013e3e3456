#include "simulation/force_models/force_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "common/bone/patient_space.h"

namespace osteomill {

void require_valid(const Burr& burr, double spacing_mm) {
    const glm::dvec3& k = burr.cutting_coefficients_n_per_mm2;
    const glm::dvec3& e = burr.edge_coefficients_n_per_mm;
    const bool good = std::isfinite(burr.diameter_mm) && burr.diameter_mm > 0.0 && burr.edges > 0 &&
                      std::isfinite(burr.spindle_rev_per_s) && burr.spindle_rev_per_s > 0.0 && is_finite(k) &&
                      k.x >= 0.0 && k.y >= 0.0 && k.z >= 0.0 && is_finite(e) && e.x >= 0.0 && e.y >= 0.0 &&
                      e.z >= 0.0;
    if (!good)
        throw std::invalid_argument("burr '" + burr.name +
                                    "' needs a diameter, edges and a spindle speed above zero and finite "
                                    "cutting and edge coefficients that are not negative");
    if (std::max(burr.diameter_mm, burr.head.length_mm) / spacing_mm > most_voxels_across_burr)
        throw std::invalid_argument("burr '" + burr.name + "' is more than 500 voxels of " +
                                    std::to_string(spacing_mm) + " mm across; take coarser bone");
    try {
        require_valid(burr.head, burr.diameter_mm);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("burr '" + burr.name + "': " + error.what());
    }
    require_valid(burr.shank, burr.radius_mm());
}

void require_ball(const Burr& burr, const char* model) {
    if (!burr.is_ball())
        throw std::invalid_argument("burr '" + burr.name + "' is no ball, and " + model +
                                    " knows the ball alone; take the force model 'milling'");
}

bool is_usable(const BurrCommand& command, std::size_t burr_count) noexcept {
    return is_finite(command.pose.position_mm) && is_finite(command.pose.spindle_axis) &&
           std::abs(glm::length(command.pose.spindle_axis) - 1.0) < 1e-6 &&
           std::isfinite(command.speed_share) && command.speed_share > 0.0 &&
           std::isfinite(command.elapsed_s) && command.elapsed_s > 0.0 && command.burr < burr_count;
}

}  // namespace osteomill
