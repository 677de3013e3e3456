// What light and shadow cost: frames of the close-up with ambient occlusion, without it, and of wet bone; and
// the shadow's map brought up to date after a carve.
#pragma once

#include <string>
#include <vector>

#include "studies/render/timed_drawing.h"
#include "studies/render/trial_bone.h"

namespace osteomill::study {

struct LightRow {
    std::string what{};
    Cost cost{};
};

/// Frames at `size_px`, and the map after a 5 mm ball is taken out of the close-up's middle. Needs a current
/// OpenGL context.
std::vector<LightRow> light_costs(const TrialBone& trial, const glm::ivec2& size_px, int times);

/// Table with a header.
std::string csv_of(const std::vector<LightRow>& rows);

}  // namespace osteomill::study
