#include "studies/force/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/bone/bone_builder.h"
#include "common/statistics/percentile.h"
#include "studies/force/bone_block.h"
#include "studies/force/full_scan.h"
#include "studies/force/path_run.h"

namespace osteomill::study {

namespace {

constexpr double scaled_voxel_mm = 0.1;
constexpr double feed_mm_per_s = 6.0;

/// Median time of a step of a burr that travels half immersed in the surface z = 0, from x = -travel/2.
double median_step_us(const MakeModel& make_model, Bone bone, const Burr& burr, double travel_mm,
                      double rate_hz) {
    const double step_mm = feed_mm_per_s / rate_hz;
    const int steps = static_cast<int>(std::lround(travel_mm / step_mm));
    std::vector<glm::dvec3> positions;
    for (int i = 0; i <= steps; ++i) positions.emplace_back(-0.5 * travel_mm + i * step_mm, 0.017, 0.0);
    const auto model = make_model(std::move(bone), burr);
    return percentile(run_path(*model, {0.0, 0.0, 1.0}, 1.0 / rate_hz, positions).step_us, 0.5);
}

ScalingRow row_of(double at, const Bone& bone, const Burr& burr, bool quick) {
    const double travel_mm = quick ? 0.9 : 2.4;
    // The scan of a step is the same at any rate: a few steps say enough.
    const double scan_1_khz_travel_mm = quick ? 0.15 : 0.4;
    return {.at = at,
            .crescent_100_hz_us = median_step_us(voxel_model(), bone, burr, travel_mm, 100.0),
            .crescent_1_khz_us = median_step_us(voxel_model(), bone, burr, travel_mm, 1000.0),
            .scan_100_hz_us = median_step_us(full_scan_model(), bone, burr, travel_mm, 100.0),
            .scan_1_khz_us = median_step_us(full_scan_model(), bone, burr, scan_1_khz_travel_mm, 1000.0)};
}

/// A cube of solid bone whose top face lies at z = 0, its middle below the origin.
Bone solid_cube(int edge_voxels) {
    const double half_mm = 0.5 * edge_voxels * scaled_voxel_mm;
    const Grid grid{.size_voxels = glm::ivec3(edge_voxels),
                    .spacing_mm = scaled_voxel_mm,
                    .origin_mm = glm::dvec3(-half_mm, -half_mm, -2.0 * half_mm) + 0.5 * scaled_voxel_mm};
    BoneBuilder builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick full;
    full.fill(255);
    const glm::ivec3 bricks = size_in_bricks(grid);  // an edge is a whole number of bricks
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) builder.add_brick({x, y, z}, full, nullptr, nullptr);
    return std::move(builder).build();
}

}  // namespace

std::vector<ScalingRow> cost_by_diameter(bool quick, const Progress& progress) {
    const std::vector diameters_mm{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0};
    std::vector<ScalingRow> rows;
    for (const double diameter_mm : diameters_mm) {
        const double reach_mm = 0.5 * diameter_mm + 2.0;
        const Bone bone =
            voxelised({.low_mm = {-reach_mm, -reach_mm, -reach_mm}, .high_mm = {reach_mm, reach_mm, 0.0}},
                      scaled_voxel_mm);
        rows.push_back(row_of(diameter_mm, bone, Burr{.diameter_mm = diameter_mm}, quick));
        progress(static_cast<double>(rows.size()) / static_cast<double>(diameters_mm.size()));
    }
    return rows;
}

std::vector<ScalingRow> cost_by_volume(int largest_voxels, bool quick, const Progress& progress) {
    std::vector<ScalingRow> rows;
    for (int edge = 128; edge <= largest_voxels; edge *= 2) {
        rows.push_back(row_of(edge, solid_cube(edge), Burr{.diameter_mm = 5.0}, quick));
        progress(std::pow(static_cast<double>(edge) / largest_voxels, 3.0));
    }
    return rows;
}

std::string csv_of(const std::vector<ScalingRow>& rows, const std::string& variable) {
    std::string csv = variable + ",crescent_100_hz_us,crescent_1_khz_us,scan_100_hz_us,scan_1_khz_us\n";
    for (const ScalingRow& r : rows)
        csv += fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f}\n", r.at, r.crescent_100_hz_us,
                           r.crescent_1_khz_us, r.scan_100_hz_us, r.scan_1_khz_us);
    return csv;
}

}  // namespace osteomill::study
