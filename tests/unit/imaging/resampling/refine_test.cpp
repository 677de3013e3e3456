#include "imaging/resampling/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/resampling/region.h"
#include "tests/support/hu_volume.h"
#include "tests/support/whole_image.h"

namespace osteomill {
namespace {

const glm::dvec3 marker_mm{3.2, -1.4, 2.1};

glm::dmat3 turned(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return glm::dmat3(glm::dvec3(c, s, 0.0), glm::dvec3(-s, c, 0.0), glm::dvec3(0.0, 0.0, 1.0));
}

/// A scan of 24 mm around the origin with a smooth blob of 2 mm at marker_mm, whichever way its axes run.
WholeImage scan_of_marker(const glm::dmat3& direction) {
    WholeImage image{{.size_voxels = {48, 30, 24}, .spacing_mm = {0.5, 0.8, 1.0}, .direction = direction}};
    image.origin_mm = -direction * (0.5 * image.spacing_mm * glm::dvec3(image.size_voxels - 1));
    for (int z = 0; z < image.size_voxels.z; ++z)
        for (int y = 0; y < image.size_voxels.y; ++y)
            for (int x = 0; x < image.size_voxels.x; ++x) {
                const double away_mm = glm::distance(position_mm(image, glm::dvec3(x, y, z)), marker_mm);
                image.values.push_back(
                    static_cast<float>(-1000.0 + 3000.0 * std::exp(-away_mm * away_mm / 4.0)));
            }
    return image;
}

/// The refined marker's place: centroid of HU above 0.
glm::dvec3 found_marker(const HuVolume& volume) {
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    std::size_t i = 0;
    for (int z = 0; z < volume.grid.size_voxels.z; ++z)
        for (int y = 0; y < volume.grid.size_voxels.y; ++y)
            for (int x = 0; x < volume.grid.size_voxels.x; ++x, ++i) {
                const double w = std::max<double>(volume.hu[i], 0.0);
                sum += w * centre_of_voxel_mm(volume.grid, {x, y, z});
                weight += w;
            }
    return sum / weight;
}

HuVolume refine(WholeImage part, const Grid& grid) {
    const Refiner refiner(part, part.values, grid);
    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    const auto slice =
        static_cast<std::size_t>(grid.size_voxels.x) * static_cast<std::size_t>(grid.size_voxels.y);
    volume.hu.resize(slice * static_cast<std::size_t>(grid.size_voxels.z));
    for (int z = 0; z < grid.size_voxels.z; ++z)
        refiner.slice(z, std::span(volume.hu).subspan(slice * static_cast<std::size_t>(z), slice));
    return volume;
}

HuVolume refined(const WholeImage& image, double spacing_mm) {
    const ScanRegion extent = extent_of(image);
    const ImageBox all{.first = {0, 0, 0}, .last = image.size_voxels - 1};
    return refine(cut(image, all), grid_over(extent, spacing_mm));
}

void expect_marker_in_place(const glm::dmat3& direction) {
    const HuVolume volume = refined(scan_of_marker(direction), 0.25);
    EXPECT_LT(glm::distance(found_marker(volume), marker_mm), 0.02);
    // The peak may lie between voxels of the scan, whose highest is then the most that may come out.
    EXPECT_GT(*std::max_element(volume.hu.begin(), volume.hu.end()), 1700);
}

TEST(Refine, PutsAMarkerWhereItIsInThePatient) {
    expect_marker_in_place(glm::dmat3(1.0));
}

TEST(Refine, HonoursReversedAxes) {
    glm::dmat3 flipped(1.0);
    flipped[0] = {-1.0, 0.0, 0.0};
    flipped[2] = {0.0, 0.0, -1.0};
    expect_marker_in_place(flipped);
}

TEST(Refine, HonoursSwappedAxes) {
    // Sagittal slices: columns run back, rows down, slices to the left.
    expect_marker_in_place(
        glm::dmat3(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, 0.0)));
}

TEST(Refine, HonoursObliqueAxes) {
    expect_marker_in_place(turned(0.35));
}

TEST(Refine, LeavesAirAroundATurnedScan) {
    const HuVolume volume = refined(scan_of_marker(turned(0.7)), 0.5);
    EXPECT_EQ(volume.hu.front(), -1000);
}

TEST(Refine, GivesTheScanBackAtItsOwnSpacing) {
    WholeImage image{{.size_voxels = {9, 8, 7}, .spacing_mm = {0.5, 0.5, 0.5}}};
    for (std::size_t i = 0; i < voxel_count(image); ++i)
        image.values.push_back(static_cast<float>((i * 7919) % 3000) - 1000.0F);
    const HuVolume volume = refined(image, 0.5);
    ASSERT_EQ(volume.hu.size(), image.values.size());
    for (std::size_t i = 0; i < volume.hu.size(); ++i) ASSERT_EQ(volume.hu[i], image.values[i]) << i;
}

TEST(Refine, NeverLeavesTheRangeOfTheScan) {
    WholeImage image{{.size_voxels = {12, 12, 12}, .spacing_mm = {1.0, 1.0, 1.0}}};
    for (std::size_t i = 0; i < voxel_count(image); ++i) image.values.push_back(i % 12 < 6 ? 0.0F : 2000.0F);
    const HuVolume volume = refined(image, 0.2);
    const auto [low, high] = std::minmax_element(volume.hu.begin(), volume.hu.end());
    EXPECT_EQ(*low, 0);
    EXPECT_EQ(*high, 2000);
}

TEST(Refine, SmoothsACheckerboardAwayWhenCoarsening) {
    WholeImage image{{.size_voxels = {40, 40, 40}, .spacing_mm = {0.25, 0.25, 0.25}}};
    for (int z = 0; z < 40; ++z)
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) image.values.push_back((x + y + z) % 2 == 0 ? 0.0F : 1000.0F);
    const HuVolume volume = refined(image, 1.0);
    // Away from the borders, where the smoothing's mirror repeats a voxel.
    const glm::ivec3 size = volume.grid.size_voxels;
    for (int z = 2; z < size.z - 2; ++z)
        for (int y = 2; y < size.y - 2; ++y)
            for (int x = 2; x < size.x - 2; ++x)
                ASSERT_NEAR(volume.hu[static_cast<std::size_t>(x + size.x * (y + size.y * z))], 500, 20);
}

TEST(Refine, AgreesWithTheWholeWhereOnlyARegionIsCut) {
    const WholeImage image = scan_of_marker(glm::dmat3(1.0));
    const ScanRegion region{.low_mm = {1.0, -3.0, 0.5}, .high_mm = {5.0, 1.0, 4.0}};
    const Grid grid = grid_over(region, 0.25);
    const ImageBox all{.first = {0, 0, 0}, .last = image.size_voxels - 1};
    const HuVolume whole = refine(cut(image, all), grid);
    const HuVolume part =
        refine(cut(image, voxels_for(image, region, glm::ivec3(refine_margin_voxels))), grid);
    for (std::size_t i = 0; i < whole.hu.size(); ++i) ASSERT_NEAR(whole.hu[i], part.hu[i], 1) << i;
}

}  // namespace
}  // namespace osteomill
