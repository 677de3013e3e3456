#include "simulation/cutting_force/axis_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "simulation/force_models/milling_model.h"
#include "studies/force/steady_run.h"
#include "tests/support/block.h"
#include "tests/support/steady_motion.h"

namespace osteomill::axis_face_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double voxel_mm = 0.1;

/// Leaning back from its motion, so that the tip leads.
glm::dvec3 leaning_back(double tilt_deg) {
    return {-std::sin(tilt_deg * degree), 0.0, std::cos(tilt_deg * degree)};
}

/// The end of the face for a burr of 2 mm that went along x in bone of `depth_mm` and goes on.
FaceEnd face_end(const std::function<double(const glm::dvec3&)>& depth_mm, const glm::dvec3& at_mm,
                 const glm::dvec3& axis) {
    MillingModel model(testing::make_block({-2.0, -1.6, -1.6}, {2.0, 1.6, 1.6}, voxel_mm, depth_mm),
                       {Burr{.diameter_mm = 2.0}}, {});
    ForgottenChanges changes;
    auto result = std::make_unique<MillingResult>();
    for (int i = -30; i <= 0; ++i)
        model.step(
            {.pose = {at_mm + glm::dvec3(0.02 * i, 0.0, 0.0), axis}, .spindle_on = true, .elapsed_s = 0.01},
            0.0, changes, *result);
    const glm::dvec3 from = to_voxel_coordinates(model.bone().grid(), at_mm);
    return AxisFace().look(model.bone(), {from, from + glm::dvec3(0.2, 0.0, 0.0), 10.0},
                           CuttingStep(Burr{}, axis, from, voxel_mm, 0.01).frame, VoxelCoverage::smoothed);
}

TEST(AxisFace, SeesOnWhichSideOfTheAxisBoneEnds) {
    const auto below = [](double height_mm) { return [=](const glm::dvec3& p) { return height_mm - p.z; }; };
    const glm::dvec3 axis = leaning_back(50.0);
    const glm::dmat3 frame = CuttingStep(Burr{}, axis, glm::dvec3(0.0), voxel_mm, 0.01).frame;
    const double tip_mm = -std::cos(50.0 * degree);
    for (const glm::dvec3 at_mm :
         {glm::dvec3(0.0), glm::dvec3(0.031, 0.017, 0.023), glm::dvec3(0.06, 0.04, 0.05)}) {
        const auto end = [&](double over_tip_mm) {
            return face_end(below(at_mm.z + tip_mm + over_tip_mm), at_mm, axis);
        };
        const FaceEnd at_tip = end(0.0);
        EXPECT_NEAR(at_tip.distance_voxels, 0.0, 0.3);
        // Across the axis, bone ends upward.
        const glm::dvec3 out = frame[0] * at_tip.across.x + frame[1] * at_tip.across.y;
        EXPECT_GT(glm::dot(out, {std::cos(50.0 * degree), 0.0, std::sin(50.0 * degree)}), 0.9);
        const double voxels_per_mm = 1.0 / (voxel_mm * std::sin(50.0 * degree));
        EXPECT_NEAR(end(0.04).distance_voxels, 0.04 * voxels_per_mm, 0.3);
        EXPECT_NEAR(end(-0.04).distance_voxels, -0.04 * voxels_per_mm, 0.3);
        EXPECT_EQ(glm::length(end(0.5).across), 0.0);
        EXPECT_EQ(glm::length(end(-0.5).across), 0.0);
    }
}

TEST(AxisFace, IsNotLookedForBehindTheMotion) {
    const glm::dvec3 forward = leaning_back(-50.0);
    const auto ends_at_tip = [](const glm::dvec3& p) { return -std::cos(50.0 * degree) - p.z; };
    EXPECT_EQ(glm::length(face_end(ends_at_tip, glm::dvec3(0.0), forward).across), 0.0);
}

TEST(AxisFace, BoneThatIsThinAllAboutHasNoLine) {
    // A tenth of every voxel is missing, as in bone that a CT shows as porous.
    const auto thin = [](const glm::dvec3&) { return 0.4 * voxel_mm; };
    for (const glm::dvec3 at_mm : {glm::dvec3(0.0), glm::dvec3(0.031, 0.017, 0.023)})
        EXPECT_LT(glm::length(face_end(thin, at_mm, leaning_back(50.0)).across), 0.2);
}

/// The largest error of the mean force, on surfaces along the lattice and aslant.
double largest_error(double diameter_mm, double depth_mm, double tilt_deg,
                     std::optional<double> groove_mm_higher,
                     const glm::dvec3& edge_n_per_mm = glm::dvec3(0.0)) {
    double largest = 0.0;
    for (const glm::dvec3 up : {glm::dvec3(0.0, 0.0, 1.0), glm::normalize(glm::dvec3(0.3, -0.5, 0.8))}) {
        const glm::dmat3 surface = CuttingStep(Burr{}, up, glm::dvec3(0.0), voxel_mm, 0.01).frame;
        study::SteadyCase c;
        c.burr = {.diameter_mm = diameter_mm, .edge_coefficients_n_per_mm = edge_n_per_mm};
        c.up = up;
        c.depth_mm = depth_mm;
        c.velocity_mm_per_s = 5.0 * (std::cos(0.4) * surface[0] + std::sin(0.4) * surface[1]);
        c.spindle_axis = glm::normalize(std::cos(tilt_deg * degree) * up -
                                        std::sin(tilt_deg * degree) * glm::normalize(c.velocity_mm_per_s));
        c.previous_groove_mm_higher = groove_mm_higher;
        const auto found = study::run_steady(c, {.voxel_mm = voxel_mm}, study::voxel_model());
        const glm::dvec3 reference =
            study::mean_reference_force_n(study::motion_of(c), study::bone_of(c), {.kappa = 360, .psi = 720});
        largest = std::max(largest, testing::relative_error(study::mean_force_n(found), reference));
    }
    return largest;
}

TEST(AxisFace, MakesUpForAnAxisThatLeavesTheBurrAtTheSurface) {
    const auto tip_at_mm = [](double diameter_mm, double tilt_deg) {
        return 0.5 * diameter_mm * (1.0 - std::cos(tilt_deg * degree));
    };
    // The means over a disc alone are off by 21, 10, 7 and 5 %,
    EXPECT_LT(largest_error(2.0, tip_at_mm(2.0, 25.0), 25.0, std::nullopt), 0.1);
    EXPECT_LT(largest_error(2.0, tip_at_mm(2.0, 40.0), 40.0, std::nullopt), 0.03);
    EXPECT_LT(largest_error(2.0, tip_at_mm(2.0, 60.0), 60.0, std::nullopt), 0.025);
    EXPECT_LT(largest_error(3.0, tip_at_mm(3.0, 50.0), 50.0, std::nullopt), 0.02);
    // and in second passes about a voxel deep by 10 and 7 %.
    EXPECT_LT(largest_error(2.2, 0.11, 14.0, 0.06), 0.045);
    EXPECT_LT(largest_error(2.2, 0.19, 21.0, 0.08), 0.045);
}

TEST(AxisFace, MakesUpForWhatEdgesLackThere) {
    const auto error = [](double diameter_mm, double tilt_deg) {
        const double tip_mm = 0.5 * diameter_mm * (1.0 - std::cos(tilt_deg * degree));
        return largest_error(diameter_mm, tip_mm, tilt_deg, std::nullopt, {0.9, 0.3, 0.1});
    };
    // Without it 0, 1, 2.
    EXPECT_LT(error(2.0, 25.0), 0.08);
    EXPECT_LT(error(2.0, 40.0), 0.03);
    EXPECT_LT(error(2.0, 60.0), 0.02);
}

}  // namespace
}  // namespace osteomill::axis_face_test
