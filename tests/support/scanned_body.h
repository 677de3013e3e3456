// Bodies whose surface is known, as a CT would show them in slices far apart, and how well a refined bone's
// surface agrees with it.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "imaging/formats/source_image.h"
#include "tests/support/hu_volume.h"
#include "tests/support/whole_image.h"

namespace osteomill {

/// Depth in bone, mm, of a place in mm: positive inside, right near the surface.
using BodyDepth = std::function<double(const glm::dvec3&)>;

/// A half-space whose surface leans by `lean_deg` against the slices, so that 90 stands across them.
BodyDepth plane(double lean_deg);
BodyDepth plate(double lean_deg, double thickness_mm);
/// Its axis leans so much.
BodyDepth rod(double lean_deg, double diameter_mm);
/// Bone at places where the other has none.
BodyDepth without(const BodyDepth& body);
/// A skull's vault: its outer radius, and where on z its top lies.
BodyDepth shell(double radius_mm, double thickness_mm, double apex_mm);
/// A gyroid.
BodyDepth trabeculae(double period_mm);

inline constexpr double scanned_bone_hu = 1200.0;
inline constexpr double scanned_threshold_hu = 600.0;  ///< half of it: where the surface is

struct ScanOfBody {
    glm::dvec3 spacing_mm{0.5, 0.5, 2.0};
    glm::dvec3 half_mm{20.0, 20.0, 16.0};  ///< around the origin
    double slice_thickness_mm = 2.0;
    double blur_fwhm_mm = 0.8;  ///< within a slice
};

/// 0 HU around bone; axes along the patient's, slices along z.
WholeImage scan_of(const BodyDepth& body, const ScanOfBody& scan);

struct Agreement {
    double median_mm = 0.0;  ///< distance between the surfaces
    double p95_mm = 0.0;
    double median_deg = 0.0;  ///< angle between their normals
    double p95_deg = 0.0;
    double volume_ratio = 0.0;  ///< to the body's own
};

/// The agreement of the surface HU = scanned_threshold_hu, without `border_mm` at the volume's faces.
Agreement agreement_of(const HuVolume& refined, const BodyDepth& body, double border_mm);

}  // namespace osteomill
