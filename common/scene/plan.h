// A plan: the region of bone to be removed, and how far beyond it a cut may go. Plain data, patient LPS.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <variant>

namespace osteomill {

/// Every voxel of this tissue.
struct TissueRegion {
    std::string tissue{};

    bool operator==(const TissueRegion&) const = default;
};

struct SphereRegion {
    glm::dvec3 centre_mm{0.0};
    double radius_mm = 1.0;

    bool operator==(const SphereRegion&) const = default;
};

/// Between two parallel discs; its ends are flat.
struct CylinderRegion {
    glm::dvec3 from_mm{0.0};
    glm::dvec3 to_mm{0.0, 0.0, 1.0};
    double radius_mm = 1.0;

    bool operator==(const CylinderRegion&) const = default;
};

using PlanRegion = std::variant<TissueRegion, SphereRegion, CylinderRegion>;

struct Plan {
    PlanRegion region{};
    double margin_mm = 0.5;  ///< what is removed beyond it is excess

    bool operator==(const Plan&) const = default;
};

}  // namespace osteomill
