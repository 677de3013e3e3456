#include "devices/tracker/point_registration.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace osteomill {

namespace {

using Points = Eigen::Matrix3Xd;

/// Root mean square of the distances from the straight line that fits best.
double spread_off_a_line_mm(const Points& points) {
    const Points centred = points.colwise() - points.rowwise().mean();
    const Eigen::Matrix3d scatter = centred * centred.transpose();
    const Eigen::Vector3d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
    return std::sqrt(std::max(0.0, along[0] + along[1]) / static_cast<double>(points.cols()));
}

void require_spread(const Points& points, const char* space) {
    if (spread_off_a_line_mm(points) < least_spread_mm)
        throw std::invalid_argument(fmt::format(
            "the points lie on one line in {}, which leaves the turn about it open; add one beside it",
            space));
}

}  // namespace

PointRegistration registered(std::span<const PointPair> pairs, double largest_residual_mm) {
    if (pairs.size() < 3)
        throw std::invalid_argument(
            fmt::format("there {} {} of [[points]]; a registration takes three or more",
                        pairs.size() == 1 ? "is" : "are", pairs.size()));
    Points tracker(3, pairs.size());
    Points patient(3, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            tracker(axis, static_cast<Eigen::Index>(i)) = pairs[i].tracker_mm[axis];
            patient(axis, static_cast<Eigen::Index>(i)) = pairs[i].patient_mm[axis];
        }
    require_spread(tracker, "the tracker's space");
    require_spread(patient, "the patient");

    const Eigen::Matrix4d motion = Eigen::umeyama(tracker, patient, false);
    PointRegistration result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) result.mapping.rotation[column][row] = motion(row, column);
        result.mapping.offset_mm[row] = motion(row, 3);
    }
    const Points moved = (motion.topLeftCorner<3, 3>() * tracker).colwise() + motion.topRightCorner<3, 1>();
    const Eigen::RowVectorXd residual = (moved - patient).colwise().norm();
    result.residual_mm.assign(residual.begin(), residual.end());
    result.rms_mm = std::sqrt(residual.squaredNorm() / static_cast<double>(pairs.size()));
    result.worst = static_cast<std::size_t>(
        std::max_element(result.residual_mm.begin(), result.residual_mm.end()) - result.residual_mm.begin());
    const double largest_mm = result.residual_mm[result.worst];
    if (!(largest_mm <= largest_residual_mm))
        throw std::invalid_argument(
            fmt::format("point '{}' is {:.2f} mm off after the best fit (rms {:.2f} mm), above "
                        "largest_residual_mm = {:g}; "
                        "measure it anew, or see whether points are exchanged",
                        pairs[result.worst].name, largest_mm, result.rms_mm, largest_residual_mm));
    return result;
}

}  // namespace osteomill
