#include "simulation/loop/burr_change.h"

#include <glm/geometric.hpp>

namespace osteomill {

void BurrChanger::tick(const std::optional<std::size_t>& request, bool spindle_on,
                       const glm::dvec3& position_mm, const MillingResult& latest) noexcept {
    if (request && *request < count_) wanted_ = *request;
    waits_for_ = BurrChange::none;
    if (wanted_ == burr_) return;
    const bool is_clear = latest.burr == burr_ && latest.wanted_burr == wanted_ &&
                          glm::distance(position_mm, latest.pose.position_mm) < latest.room_for_change_mm;
    if (spindle_on)
        waits_for_ = BurrChange::spindle;
    else if (!is_clear)
        waits_for_ = BurrChange::bone;
    else
        burr_ = wanted_;
}

}  // namespace osteomill
