#include "simulation/coupling/virtual_damper.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace osteomill {

CouplingOutput VirtualDamper::tick(const HandState& hand, const MillingResult& latest) noexcept {
    CouplingOutput output = base_->tick(hand, latest);
    const double contact = std::min(1.0, glm::length(output.force_n) / full_at_n);
    output.force_n -= damping_n_s_per_mm_ * contact * hand.velocity_mm_per_s;
    return output;
}

}  // namespace osteomill
