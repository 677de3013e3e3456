// How far the normals of surfaces are off, by the way they are taken from the voxels: light shows a few
// degrees in step with the lattice as rings.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace osteomill::study {

struct NormalError {
    std::string surface{};  ///< "planes" of random direction; "ball": the surface voxels of one of 25 voxels
    std::string method{};
    bool is_default = false;  ///< what render_client does by default
    double median_deg = 0.0;
    double p95_deg = 0.0;
};

/// The candidates, on planes and of surface voxels. Directions are drawn from `seed`.
std::vector<NormalError> normal_errors(unsigned seed);

/// Table with a header.
std::string csv_of(const std::vector<NormalError>& errors);

/// Between two vectors, neither of which is zero; degrees.
double angle_deg(const glm::dvec3& a, const glm::dvec3& b);

/// The value below which a share (0 to 1) of the values lies; there is at least one.
double quantile_of(std::vector<double> values, double share);

}  // namespace osteomill::study
