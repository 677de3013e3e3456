#include "imaging/resampling/slice_shapes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <vector>

#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/in_parallel.h"
#include "imaging/resampling/refine.h"
#include "imaging/resampling/region.h"
#include "tests/support/scanned_body.h"
#include "tests/support/whole_image.h"

namespace osteomill::slice_shapes_test {
namespace {

const ScanRegion middle{.low_mm = glm::dvec3(-7.0), .high_mm = glm::dvec3(7.0)};
constexpr double border_mm = 1.0;

HuVolume refined(const WholeImage& scan, bool follows, double spacing_mm = 0.25) {
    WholeImage part = cut(scan, {.first = glm::ivec3(0), .last = scan.size_voxels - 1});
    HuVolume volume{.grid = grid_over(middle, spacing_mm), .hu = {}, .tissue = {}};
    std::vector<float> room(part.values.size() * SliceShapes::floats_per_voxel);
    std::optional<SliceShapes> shapes;
    if (const std::optional<int> axis = axis_of_far_slices(part.spacing_mm); axis && follows)
        shapes.emplace(part, part.values, *axis, scanned_threshold_hu, spacing_mm, room);
    const Refiner refiner(part, part.values, volume.grid, shapes ? &*shapes : nullptr);
    const auto slice = static_cast<std::size_t>(voxels_of_slice(volume.grid));
    volume.hu.resize(slice * static_cast<std::size_t>(volume.grid.size_voxels.z));
    in_parallel(volume.grid.size_voxels.z, [&](int z) {
        refiner.slice(z, std::span(volume.hu).subspan(slice * static_cast<std::size_t>(z), slice));
    });
    return volume;
}

struct Compared {
    Agreement blended;
    Agreement followed;
};

/// The figures are printed, too.
Compared compare(const std::string& name, const WholeImage& scan, const BodyDepth& body) {
    const Compared both{.blended = agreement_of(refined(scan, false), body, border_mm),
                        .followed = agreement_of(refined(scan, true), body, border_mm)};
    const auto row = [&](const char* how, const Agreement& of) {
        fmt::print(
            "{:22} {:8} surface {:.3f} (p95 {:.3f}) mm, normals {:5.2f} (p95 {:5.2f}) deg, volume {:.4f}\n",
            name, how, of.median_mm, of.p95_mm, of.median_deg, of.p95_deg, of.volume_ratio);
    };
    row("blended", both.blended);
    row("followed", both.followed);
    return both;
}

/// With slices as thick as they are apart, or half as thick.
Compared compare(const std::string& name, const BodyDepth& body, double thickness_mm = 2.0) {
    return compare(fmt::format("{}, {:.0f} mm thick", name, thickness_mm),
                   scan_of(body, {.slice_thickness_mm = thickness_mm}), body);
}

TEST(SliceShapes, AreForSlicesFurtherApartThanPixels) {
    EXPECT_EQ(axis_of_far_slices({0.5, 0.5, 2.0}), 2);
    EXPECT_EQ(axis_of_far_slices({2.0, 0.5, 0.5}), 0);
    EXPECT_EQ(axis_of_far_slices({0.4, 0.5, 0.5}), std::nullopt);
    EXPECT_EQ(axis_of_far_slices({0.5, 0.5, 0.7}), std::nullopt);
    EXPECT_EQ(axis_of_far_slices({0.5, 2.0, 2.0}), std::nullopt);
}

TEST(SliceShapes, ALeaningSurfaceHasNoStairs) {
    for (const double thickness_mm : {1.0, 2.0})
        for (const double lean_deg : {10.0, 20.0, 45.0}) {
            const Compared of =
                compare(fmt::format("plane leans {:.0f}", lean_deg), plane(lean_deg), thickness_mm);
            EXPECT_LT(of.followed.p95_mm, 0.05);
            EXPECT_LT(of.followed.p95_deg, 2.0);
            EXPECT_GT(of.blended.p95_deg, 5.0) << "else nothing is shown";
            EXPECT_NEAR(of.followed.volume_ratio, 1.0, 0.001);
        }
}

TEST(SliceShapes, ASkullsVaultIsSmooth) {
    // Beside its top, where it leans by 10 to 25 degrees.
    const BodyDepth vault = [](const glm::dvec3& p) {
        return shell(60.0, 6.0, 3.0)(p + glm::dvec3(18.0, 0.0, 0.0));
    };
    for (const double thickness_mm : {1.0, 2.0}) {
        const Compared of = compare("vault of 60 mm", vault, thickness_mm);
        EXPECT_LT(of.followed.median_deg, 0.25 * of.blended.median_deg);
        EXPECT_LT(of.followed.p95_deg, 0.5 * of.blended.p95_deg);
        EXPECT_LT(of.followed.median_mm, 0.5 * of.blended.median_mm);
        EXPECT_NEAR(of.followed.volume_ratio, 1.0, 0.01);
    }
}

TEST(SliceShapes, WhereAVaultsLastContourEndsTheStepIsNoHigher) {
    for (const double thickness_mm : {1.0, 2.0}) {
        const Compared of = compare("top of it", shell(60.0, 6.0, 3.0), thickness_mm);
        EXPECT_LT(of.followed.median_mm, of.blended.median_mm + 0.01);
        EXPECT_LT(of.followed.p95_mm, of.blended.p95_mm + 0.03);
        EXPECT_LT(of.followed.p95_deg, of.blended.p95_deg + 2.0);
        EXPECT_NEAR(of.followed.volume_ratio, of.blended.volume_ratio, 0.01);
    }
}

TEST(SliceShapes, WhatIsNoSurfaceFromSliceToSliceStaysAsItWas) {
    const auto expect_same = [](const BodyDepth& body) {
        const WholeImage scan = scan_of(body, {});
        EXPECT_EQ(refined(scan, true).hu, refined(scan, false).hu);
    };
    expect_same(plane(90.0));
    expect_same(plate(0.0, 1.2));
    expect_same(plate(20.0, 1.2));
    expect_same(rod(0.0, 3.0));
}

TEST(SliceShapes, ThinBonesAndHolesAreNoWorse) {
    const auto expect_no_worse = [](const std::string& name, const BodyDepth& body) {
        const Compared of = compare(name, body);
        EXPECT_LT(of.followed.median_mm, of.blended.median_mm + 0.01);
        EXPECT_LT(of.followed.p95_mm, of.blended.p95_mm + 0.01);
        EXPECT_LT(of.followed.p95_deg, of.blended.p95_deg + 1.0);
        EXPECT_NEAR(of.followed.volume_ratio, of.blended.volume_ratio, 0.02);
    };
    expect_no_worse("plate of 3 mm", plate(45.0, 3.0));
    expect_no_worse("rod of 3 mm, 20", rod(20.0, 3.0));
    expect_no_worse("rod of 3 mm, 45", rod(45.0, 3.0));
    expect_no_worse("canal of 3 mm, 45", without(rod(45.0, 3.0)));
    expect_no_worse("trabeculae of 4 mm", trabeculae(4.0));
}

TEST(SliceShapes, HuInTheSlicesStayTheScans) {
    const BodyDepth body = shell(30.0, 6.0, 7.3);
    const WholeImage scan = scan_of(body, {});
    const HuVolume followed = refined(scan, true, 0.5);
    const HuVolume blended = refined(scan, false, 0.5);
    const glm::ivec3 size = followed.grid.size_voxels;
    std::size_t i = 0;
    std::size_t moved = 0;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x, ++i) {
                // Slices lie at even mm; the grid begins at -7.
                if ((z - 2) % 4 == 0)
                    ASSERT_EQ(followed.hu[i], blended.hu[i]) << x << ' ' << y << ' ' << z;
                else
                    moved += followed.hu[i] != blended.hu[i];
            }
    EXPECT_GT(moved, 1000u);
}

TEST(SliceShapes, FollowContoursWhicheverWayTheScanIsTurned) {
    const BodyDepth body = plane(30.0);
    const WholeImage scan = scan_of(body, {});
    const glm::dmat3 sagittal(glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0),
                              glm::dvec3(1.0, 0.0, 0.0));
    const glm::dmat3 oblique(glm::dvec3(std::cos(0.3), std::sin(0.3), 0.0),
                             glm::dvec3(-std::sin(0.3), std::cos(0.3), 0.0), glm::dvec3(0.0, 0.0, 1.0));
    for (const glm::dmat3& direction : {sagittal, oblique}) {
        WholeImage turned = scan;
        turned.direction = direction;
        turned.origin_mm = direction * scan.origin_mm;
        const Compared of = compare("turned plane", turned, [&](const glm::dvec3& at_mm) {
            return body(glm::transpose(direction) * at_mm);
        });
        EXPECT_LT(of.followed.p95_mm, 0.05);
        EXPECT_LT(of.followed.p95_deg, 2.0);
        EXPECT_GT(of.blended.p95_deg, 7.0);
    }
}

}  // namespace
}  // namespace osteomill::slice_shapes_test
