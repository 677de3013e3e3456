// The rigid motion from a tracker's space to the patient's that brings pairs of points together: rotation and
// offset that minimise the sum of squared distances,
//
//     sum_i | patient_i - (R tracker_i + t) |^2,    R a rotation, no scale
//
// after Umeyama 1991 (IEEE Trans PAMI 13:376), as Eigen has it. The residual is the remaining distance at
// each pair. A small residual does not prove that the burr is at its displayed position: that depends on the
// points' positions (around the field is best), and it does not show a marker that has moved since.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

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

}  // namespace osteomill
