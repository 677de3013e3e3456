// A steady motion over a half space, and its force by an independent quadrature: one entry of a case file in
// the schema of tests/data/milling_forces.json.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/scene/burr.h"
#include "simulation/cutting_force/reference_force.h"

namespace osteomill::study {

/// A burr in steady motion over bone {p . up <= 0}; patient axes.
struct SteadyCase {
    std::string name{};
    Burr burr{};
    glm::dvec3 velocity_mm_per_s{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, tip to shank
    glm::dvec3 up{0.0, 0.0, 1.0};            ///< unit, out of the bone; +z in a case file
    double depth_mm = 0.0;                   ///< the burr's lowest point's
    /// The same burr cut a groove along the velocity before, that much higher.
    std::optional<double> previous_groove_mm_higher{};
    glm::dvec3 mean_force_n{0.0};    ///< from the case file
    double removal_mm3_per_s = 0.0;  ///< from the case file
};

/// Prints the name, for test reports.
std::ostream& operator<<(std::ostream& out, const SteadyCase& c);

/// How high the burr's origin stands above its lowest point, along `up`: a ball's radius.
double above_lowest_mm(const SteadyCase& c);

/// The steady motion, with the burr at the case's depth.
SteadyMotion motion_of(const SteadyCase& c);

/// The bone that the motion meets, as the analytical reference wants it.
BoneFunction bone_of(const SteadyCase& c);

/// Reads a case file: a JSON array of objects with exactly these keys:
///     name                        text
///     radius_mm                   above 0
///     velocity_mm_s               three numbers, not all zero
///     spindle_axis                three numbers, not all zero; taken as a direction
///     depth_mm                    above 0
///     rpm                         above 0
///     edges                       whole, 1 or more
///     K_N_mm2                     K_t, K_r, K_a: three numbers, none negative
///     spin                        1 or -1 (counter-clockwise or clockwise seen from the handpiece)
///     previous_groove_mm_higher   null, or above 0
///     mean_force_N                three numbers
///     removal_mm3_s               0 or more
/// Throws std::runtime_error in one line that names the file, the case and the key, and says what would be
/// right: for a file that cannot be read, is no JSON or holds no case, a missing or unknown key, a bad value.
std::vector<SteadyCase> read_steady_cases(const std::filesystem::path& file);

}  // namespace osteomill::study
