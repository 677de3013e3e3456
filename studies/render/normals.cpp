#include "studies/render/normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "render_client/volume/textures/smoothed_fraction.h"
#include "studies/render/reference_volume.h"
#include "tests/unit/volume/made_bone.h"

namespace osteomill::study {

namespace {

constexpr int planes = 100;
constexpr int points_on_plane = 40;
constexpr double ball_voxels = 25.0;

using Gradient = std::function<glm::dvec3(const ReferenceVolume& volume, const glm::dvec3& point)>;

/// Of the fractions themselves, between the corners of a cube.
glm::dvec3 gradient_of_corners(const ReferenceVolume& volume, const glm::dvec3& point) {
    constexpr double reach = 0.4;
    glm::dvec3 gradient(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side(2 * (corner & 1) - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
        gradient += side * volume.fraction_at(point + reach * side);
    }
    return gradient;
}

/// bone_sampling.glsl's gradient_by_samples, up to a factor.
glm::dvec3 gradient_of_samples(const ReferenceVolume& volume, const glm::dvec3& point) {
    glm::dvec3 gradient(0.0);
    for (int sample = 0; sample < 64; ++sample) {
        const glm::dvec3 offset = glm::dvec3(sample & 3, sample >> 2 & 3, sample >> 4) - 1.5;
        const glm::dvec3 is_outer(std::abs(offset.x) > 1.0, std::abs(offset.y) > 1.0,
                                  std::abs(offset.z) > 1.0);
        const glm::dvec3 w = 3.5 - 2.5 * is_outer, along = glm::sign(offset) * (1.0 + 0.5 * is_outer);
        gradient += along * glm::dvec3(w.y * w.z, w.z * w.x, w.x * w.y) * volume.fraction_at(point + offset);
    }
    return gradient;
}

struct Candidate {
    std::string method;
    Gradient gradient;
    bool is_default = false;
};

const std::vector<Candidate>& candidates() {
    static const std::vector<Candidate> all{
        {"slope of the trilinear fraction",
         [](const ReferenceVolume& volume, const glm::dvec3& point) {
             return volume.trilinear_gradient_at(point);
         }},
        {"eight corners of the fractions", gradient_of_corners},
        {"4^3 samples of the fractions (where memory is short)", gradient_of_samples},
        {"eight corners of smoothed fractions",
         [](const ReferenceVolume& volume, const glm::dvec3& point) {
             return volume.eight_corner_gradient_at(point);
         },
         true}};
    return all;
}

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(glm::dvec3(x, y, z));
}

NormalError summary(std::string surface, std::string method, bool is_default,
                    const std::vector<double>& angles_deg) {
    return {std::move(surface), std::move(method), is_default, quantile_of(angles_deg, 0.5),
            quantile_of(angles_deg, 0.95)};
}

std::vector<NormalError> on_planes(unsigned seed) {
    std::mt19937 random(seed);
    const Grid grid{.size_voxels = glm::ivec3(32), .spacing_mm = 1.0};
    const glm::dvec3 middle(15.5);
    std::vector<std::vector<double>> angles_deg(candidates().size());
    for (int plane = 0; plane < planes; ++plane) {
        const glm::dvec3 outward = random_direction(random);
        const glm::dvec3 on_plane = middle + 0.5 * random_direction(random);
        const Bone bone =
            made_bone(grid, [&](const glm::dvec3& p) { return glm::dot(outward, on_plane - p); });
        const ReferenceVolume volume(bone, {}, {});
        for (int point = 0; point < points_on_plane; ++point) {
            const glm::dvec3 aside = glm::cross(outward, random_direction(random));
            const glm::dvec3 place = on_plane + 8.0 * aside + 0.5 - glm::dvec3(volume.box().first);
            for (std::size_t i = 0; i < candidates().size(); ++i)
                angles_deg[i].push_back(angle_deg(-candidates()[i].gradient(volume, place), outward));
        }
    }
    std::vector<NormalError> errors;
    for (std::size_t i = 0; i < candidates().size(); ++i)
        errors.push_back(
            summary("planes", candidates()[i].method, candidates()[i].is_default, angles_deg[i]));
    return errors;
}

/// The sum over the 26 neighbours, or over those of them that are less than half full, of the direction to
/// them weighted by the gradient along it.
glm::dvec3 sum_over_neighbours(const std::array<int, 27>& fractions, const std::array<int, 27>& values,
                               bool only_outside) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 27; ++i) {
        const auto neighbour = static_cast<std::size_t>(i);
        if (i == 13 || (only_outside && fractions[neighbour] >= 128)) continue;
        const glm::dvec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        sum += (values[13] - values[neighbour]) / glm::dot(step, step) * step;
    }
    return sum;
}

std::vector<NormalError> of_surface_voxels() {
    const glm::dvec3 centre(31.3, 32.1, 30.7);
    const Grid grid{.size_voxels = glm::ivec3(64), .spacing_mm = 1.0};
    const Bone bone =
        made_bone(grid, [&](const glm::dvec3& p) { return ball_voxels - glm::length(p - centre); });
    FractionSmoother smoother{LookTable{}};
    const VoxelBox whole{{0, 0, 0}, grid.size_voxels};
    const auto smoothed = smoother.smooth(bone, whole);
    std::vector<double> published_deg, ours_deg;
    for (int z = 1; z < 63; ++z)
        for (int y = 1; y < 63; ++y)
            for (int x = 1; x < 63; ++x) {
                std::array<int, 27> fractions{}, smooth{};
                for (int i = 0; i < 27; ++i) {
                    const glm::ivec3 voxel = glm::ivec3(x, y, z) + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
                    fractions[static_cast<std::size_t>(i)] = bone.fraction_at(voxel);
                    smooth[static_cast<std::size_t>(i)] =
                        smoothed[(static_cast<std::size_t>(voxel.z) * 64 + voxel.y) * 64 + voxel.x];
                }
                const bool is_surface =
                    fractions[13] >= 128 && *std::min_element(fractions.begin(), fractions.end()) < 128;
                if (!is_surface) continue;
                const glm::dvec3 outward = glm::dvec3(x, y, z) - centre;
                published_deg.push_back(angle_deg(sum_over_neighbours(fractions, fractions, true), outward));
                ours_deg.push_back(angle_deg(sum_over_neighbours(fractions, smooth, false), outward));
            }
    return {summary("ball", "surface voxels, neighbours outside (published)", false, published_deg),
            summary("ball", "surface voxels, all neighbours of smoothed fractions", false, ours_deg)};
}

}  // namespace

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    const double cosine = glm::dot(a, b) / (glm::length(a) * glm::length(b));
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

double quantile_of(std::vector<double> values, double share) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

std::vector<NormalError> normal_errors(unsigned seed) {
    std::vector<NormalError> errors = on_planes(seed);
    const std::vector<NormalError> more = of_surface_voxels();
    errors.insert(errors.end(), more.begin(), more.end());
    return errors;
}

std::string csv_of(const std::vector<NormalError>& errors) {
    std::string csv = "surface,method,is_default,median_deg,p95_deg\n";
    for (const NormalError& e : errors)
        csv += fmt::format("{},\"{}\",{},{:.3f},{:.3f}\n", e.surface, e.method, e.is_default ? 1 : 0,
                           e.median_deg, e.p95_deg);
    return csv;
}

}  // namespace osteomill::study
