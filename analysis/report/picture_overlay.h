// Overlay of a picture of bone: a scale bar, the patient's directions as radiologists write them (R,
// L, A, P, S, I at the edges they lie beyond) and the burr.
#pragma once

#include <optional>
#include <string>

#include "imaging/picture/bone_picture.h"

namespace osteomill {

/// Letters of a direction in patient LPS, the largest component first: "R", "LA". A component below 0.35 has
/// none.
std::string direction_letters(const glm::dvec3& direction);

struct SeenBurr {
    glm::dvec3 centre_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, from tip to shank
    double diameter_mm = 1.0;
};

/// An SVG as large as the picture.
std::string picture_overlay(const BoneView& view, const std::optional<SeenBurr>& burr = {});

}  // namespace osteomill
