// The file of --tracker-registration (TOML): how a tracked handpiece stands to its marker, where its pedal
// comes from, and the pairs of points that place the tracker's space on the patient.
//
//     [tool]                              # in the marker's frame, as its TRANSFORM has it
//     burr_centre_mm = [0, 0, 150]
//     spindle_axis = [0, 0, -1]           # from the burr's tip to the shank
//     [pedal]
//     string = "Pedal"                    # the name of a STRING message; or: always = true
//     [registration]
//     largest_residual_mm = 2             # default
//     [[points]]
//     name = "mastoid tip"
//     tracker_mm = [102.1, -33.0, -1204.8]
//     patient_mm = [57.2, 21.9, -40.3]    # LPS
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

// The rigid motion from a tracker's space to the patient's that brings pairs of points together: rotation and
// offset that minimise the sum of squared distances,
//
//     sum_i | patient_i - (R tracker_i + t) |^2,    R a rotation, no scale
//
// after Umeyama 1991 (IEEE Trans PAMI 13:376), as Eigen has it. The residual is the remaining distance at
// each pair. A small residual does not prove that the burr is at its displayed position: that depends on the
// points' positions (around the field is best), and it does not show a marker that has moved since.

/// One point, touched with the tracked pointer and found in the scan.
struct PointPair {
    std::string name;
    glm::dvec3 tracker_mm{0.0};  ///< as the tracker says
    glm::dvec3 patient_mm{0.0};  ///< patient LPS
};

struct PointRegistration {
    DeviceMapping mapping;            ///< tracker to patient LPS; its scale is 1
    std::vector<double> residual_mm;  ///< one for each pair
    double rms_mm = 0.0;
    std::size_t worst = 0;  ///< the pair with the largest
};

/// Points that lie nearer than this (root mean square) to one straight line leave the turn about it open.
inline constexpr double least_spread_mm = 1.0;

/// Throws std::invalid_argument with one line for fewer than three pairs, for points along a line (in either
/// space), and for a residual above `largest_residual_mm`: with the name of the worst.
PointRegistration registered(std::span<const PointPair> pairs, double largest_residual_mm);

/// A tracked handpiece, in its marker's frame.
struct TrackedHandpiece {
    glm::dvec3 burr_centre_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit vector from tip to shank
    std::string pedal;                       ///< the device name of STRING messages; empty: always down
};

struct TrackerSetup {
    TrackedHandpiece handpiece;
    PointRegistration registration;
    std::vector<PointPair> points;
};

/// Throws std::runtime_error in one line, with the file and, if known, the line in it, for entries that are
/// missing, wrong or out of range, and for pairs that registered() refuses.
TrackerSetup parse_tracker_setup(std::string_view toml, const std::string& name);
TrackerSetup read_tracker_setup(const std::filesystem::path& path);

/// "registered by 4 points: residual 0.31 mm (rms), 0.52 mm at the most, at 'mastoid tip'"
std::string residual_line(const TrackerSetup& setup);

}  // namespace osteomill
