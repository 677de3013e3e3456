// The law by which milling removes bone, from its definition: a ramp of one voxel, or its mean over some.
#pragma once

#include <algorithm>

namespace osteomill::testing {

/// Share that is left, 0 to 1, of a voxel whose centre is `beyond` outside of the burr's surface; in voxels.
/// The mean is a difference of two integrals of the ramp.
inline double left_by_ramp(double beyond, double smoothing) {
    const auto ramp = [](double u) { return std::clamp(0.5 + u, 0.0, 1.0); };
    if (smoothing == 0.0) return ramp(beyond);
    const auto integral = [&](double u) { return 0.5 * ramp(u) * ramp(u) + std::max(0.0, u - 0.5); };
    return (integral(beyond + 0.5 * smoothing) - integral(beyond - 0.5 * smoothing)) / smoothing;
}

}  // namespace osteomill::testing
