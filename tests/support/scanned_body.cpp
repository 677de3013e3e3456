#include "tests/support/scanned_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "imaging/in_parallel.h"

namespace osteomill {

namespace {

double rad(double deg) {
    return deg * std::numbers::pi / 180.0;
}

constexpr int taps = 7;  // within a slice, along each axis
constexpr int taps_across = 17;

/// Places and weights of a Gaussian, standard deviation 1.
std::array<double, taps> gaussian_places() {
    std::array<double, taps> places{};
    for (int i = 0; i < taps; ++i) places[static_cast<std::size_t>(i)] = 0.8 * (i - taps / 2);
    return places;
}

double share_of_bone(double depth_mm) {
    constexpr double edge_mm = 0.2;  // as wide as the places are apart
    return std::clamp(0.5 + depth_mm / edge_mm, 0.0, 1.0);
}

double percentile(std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

glm::dvec3 inward(const BodyDepth& body, const glm::dvec3& at_mm) {
    constexpr double step_mm = 1e-3;
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = step_mm;
        slope[axis] = body(at_mm + step) - body(at_mm - step);
    }
    return glm::normalize(slope);
}

class Refined {
  public:
    explicit Refined(const HuVolume& volume) : volume_(volume), size_(volume.grid.size_voxels) {}
    double hu(const glm::ivec3& voxel) const {
        return volume_.hu[static_cast<std::size_t>(voxel.x + size_.x * (voxel.y + size_.y * voxel.z))];
    }
    glm::dvec3 slope(const glm::ivec3& voxel) const {
        glm::dvec3 out;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 step(0);
            step[axis] = 1;
            out[axis] = hu(voxel + step) - hu(voxel - step);
        }
        return out;
    }

  private:
    const HuVolume& volume_;
    glm::ivec3 size_;
};

}  // namespace

BodyDepth plane(double lean_deg) {
    const glm::dvec3 up =
        glm::normalize(glm::dvec3(std::sin(rad(lean_deg)) * std::cos(0.4),
                                  std::sin(rad(lean_deg)) * std::sin(0.4), std::cos(rad(lean_deg))));
    return [up](const glm::dvec3& p) { return 0.37 - glm::dot(p, up); };
}
BodyDepth plate(double lean_deg, double thickness_mm) {
    const BodyDepth half = plane(lean_deg);
    return [=](const glm::dvec3& p) { return 0.5 * thickness_mm - std::abs(half(p)); };
}
BodyDepth rod(double lean_deg, double diameter_mm) {
    const glm::dvec3 along =
        glm::normalize(glm::dvec3(std::cos(rad(lean_deg)) * std::cos(0.4),
                                  std::cos(rad(lean_deg)) * std::sin(0.4), std::sin(rad(lean_deg))));
    return [=](const glm::dvec3& p) { return 0.5 * diameter_mm - glm::length(glm::cross(p, along)); };
}
BodyDepth without(const BodyDepth& body) {
    return [=](const glm::dvec3& p) { return -body(p); };
}
BodyDepth shell(double radius_mm, double thickness_mm, double apex_mm) {
    return [=](const glm::dvec3& p) {
        const double from_mm = glm::length(p - glm::dvec3(0.0, 0.0, apex_mm - radius_mm));
        return std::min(radius_mm - from_mm, from_mm - radius_mm + thickness_mm);
    };
}
BodyDepth trabeculae(double period_mm) {
    const double k = 2.0 * std::numbers::pi / period_mm;
    return [=](const glm::dvec3& p) {
        const double level = std::sin(k * p.x) * std::cos(k * p.y) + std::sin(k * p.y) * std::cos(k * p.z) +
                             std::sin(k * p.z) * std::cos(k * p.x);
        return level / (1.3 * k);
    };
}

WholeImage scan_of(const BodyDepth& body, const ScanOfBody& scan) {
    WholeImage image{{.size_voxels = glm::ivec3(2.0 * scan.half_mm / scan.spacing_mm) + 1,
                      .spacing_mm = scan.spacing_mm,
                      .origin_mm = -scan.half_mm}};
    const std::array<double, taps> gaussian = gaussian_places();
    const double sigma_mm = scan.blur_fwhm_mm / 2.3548200450309493;
    const int nx = image.size_voxels.x;
    const int ny = image.size_voxels.y;
    image.values.resize(voxel_count(image));
    in_parallel(image.size_voxels.z, [&](int z) {
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                const glm::dvec3 centre_mm = position_mm(image, glm::dvec3(x, y, z));
                double sum = 0.0;
                double weights = 0.0;
                // Far from the surface all of it is bone, or none.
                const double depth_mm = body(centre_mm);
                const double felt_mm = scan.slice_thickness_mm + 4.0 * sigma_mm;
                if (std::abs(depth_mm) > felt_mm) {
                    sum = depth_mm > 0.0 ? 1.0 : 0.0;
                    weights = 1.0;
                } else {
                    for (int k = 0; k < taps_across; ++k)
                        for (const double v : gaussian)
                            for (const double u : gaussian) {
                                const double weight = std::exp(-0.5 * (u * u + v * v));
                                const double across_mm =
                                    scan.slice_thickness_mm * ((k + 0.5) / taps_across - 0.5);
                                weights += weight;
                                sum += weight *
                                       share_of_bone(body(centre_mm +
                                                          glm::dvec3(u * sigma_mm, v * sigma_mm, across_mm)));
                            }
                }
                image.values[static_cast<std::size_t>(x + nx * (y + ny * z))] =
                    static_cast<float>(scanned_bone_hu * sum / weights);
            }
    });
    return image;
}

Agreement agreement_of(const HuVolume& refined, const BodyDepth& body, double border_mm) {
    const Refined field(refined);
    const Grid& grid = refined.grid;
    const int border = std::max(1, static_cast<int>(border_mm / grid.spacing_mm));
    std::vector<double> away_mm;
    std::vector<double> angle_deg;
    double volume = 0.0;
    double true_volume = 0.0;
    glm::ivec3 voxel;
    for (voxel.z = border; voxel.z + border + 1 < grid.size_voxels.z; ++voxel.z)
        for (voxel.y = border; voxel.y + border + 1 < grid.size_voxels.y; ++voxel.y)
            for (voxel.x = border; voxel.x + border + 1 < grid.size_voxels.x; ++voxel.x) {
                const double here = field.hu(voxel) - scanned_threshold_hu;
                const glm::dvec3 slope = field.slope(voxel);
                const double steepness = 0.5 * glm::length(slope);
                const glm::dvec3 centre_mm = centre_of_voxel_mm(grid, voxel);
                true_volume += std::clamp(0.5 + body(centre_mm) / grid.spacing_mm, 0.0, 1.0);
                volume += steepness > 0.0 ? std::clamp(0.5 + here / steepness, 0.0, 1.0) : here >= 0.0;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 step(0);
                    step[axis] = 1;
                    const double there = field.hu(voxel + step) - scanned_threshold_hu;
                    if ((here >= 0.0) == (there >= 0.0)) continue;
                    const double share = here / (here - there);
                    const glm::dvec3 at_mm = centre_mm + glm::dvec3(step) * (share * grid.spacing_mm);
                    away_mm.push_back(std::abs(body(at_mm)));
                    const glm::dvec3 normal =
                        glm::normalize((1.0 - share) * slope + share * field.slope(voxel + step));
                    angle_deg.push_back(
                        std::acos(std::clamp(glm::dot(normal, inward(body, at_mm)), -1.0, 1.0)) * 180.0 /
                        std::numbers::pi);
                }
            }
    return {.median_mm = percentile(away_mm, 0.5),
            .p95_mm = percentile(away_mm, 0.95),
            .median_deg = percentile(angle_deg, 0.5),
            .p95_deg = percentile(angle_deg, 0.95),
            .volume_ratio = volume / true_volume};
}

}  // namespace osteomill
