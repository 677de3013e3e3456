#include "render_client/ui/view/cut_settings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

glm::dvec3 axis_of(std::size_t cut) {
    glm::dvec3 axis(0.0);
    axis[static_cast<int>(cut)] = 1.0;
    return axis;
}

}  // namespace

void CutSettings::set_bounds(const glm::dvec3& low_mm, const glm::dvec3& high_mm) {
    middle_mm_ = 0.5 * (low_mm + high_mm);
    half_mm_ = 0.5 * (high_mm - low_mm);
    for (std::size_t cut = 0; cut < count; ++cut) {
        const double reach = reach_mm(cut);
        cuts_[cut].position_mm = std::clamp(cuts_[cut].position_mm, -reach, reach);
    }
}

void CutSettings::step(std::size_t index, const Camera& camera) {
    Cut& cut = cuts_[index];
    last_ = index;
    if (index == across_view) {
        cut = cut.is_on ? Cut{} : Cut{.is_on = true, .normal = -camera.forward()};
        return;
    }
    const glm::dvec3 axis = axis_of(index);
    if (!cut.is_on)
        cut = {.is_on = true, .normal = glm::dot(axis, camera.forward()) > 0.0 ? -axis : axis};
    else if (!cut.is_turned)
        turn_over(index);
    else
        cut.is_on = false;
}

void CutSettings::set(std::size_t axis, const glm::dvec3& normal, double position_mm) {
    cuts_[axis] = {.is_on = true, .normal = normal, .position_mm = position_mm};
    last_ = axis;
}

void CutSettings::turn_over(std::size_t index) {
    Cut& cut = cuts_[index];
    last_ = index;
    cut.normal = -cut.normal;
    cut.position_mm = -cut.position_mm;
    cut.is_turned = !cut.is_turned;
}

void CutSettings::move_to(std::size_t index, double position_mm) {
    const double reach = reach_mm(index);
    cuts_[index].position_mm = std::clamp(position_mm, -reach, reach);
    if (cuts_[index].is_on) last_ = index;
}

void CutSettings::move_last(double outwards_mm) {
    if (cuts_[last_].is_on) move_to(last_, cuts_[last_].position_mm + outwards_mm);
}

double CutSettings::reach_mm(std::size_t index) const {
    return glm::dot(glm::abs(cuts_[index].normal), half_mm_);
}

bool CutSettings::any() const {
    return std::any_of(cuts_.begin(), cuts_.end(), [](const Cut& cut) { return cut.is_on; });
}

std::vector<CutPlane> CutSettings::planes() const {
    std::vector<CutPlane> planes;
    for (const Cut& cut : cuts_)
        if (cut.is_on) planes.push_back({cut.normal, glm::dot(cut.normal, middle_mm_) + cut.position_mm});
    return planes;
}

}  // namespace osteomill
