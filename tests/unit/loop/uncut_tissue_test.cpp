// A hand presses a turning burr through bone onto tissue that no burr cuts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "common/bone/bone_builder.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/coupling/couplings.h"
#include "simulation/force_models/force_models.h"
#include "simulation/force_models/milling_model.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {
namespace {

constexpr std::uint8_t bone_label = 1;
constexpr std::uint8_t implant_label = 2;
constexpr double implant_top_mm = -1.0;

/// 8 x 8 mm, its top at z = 0; from 1 mm down an implant.
Bone bone_on_implant() {
    const Grid grid{.size_voxels = {80, 80, 32}, .spacing_mm = 0.1, .origin_mm = {-3.95, -3.95, -3.15}};
    return filled(BoneBuilder::homogeneous(grid, 1.0, true), grid, [&](const glm::ivec3& voxel) {
        const bool is_implant = centre_of_voxel_mm(grid, voxel).z < implant_top_mm;
        return VoxelValues{.fraction = 255, .tissue = is_implant ? implant_label : bone_label};
    });
}

Scene implant_scene(const Burr& burr) {
    Scene scene;
    scene.burrs = {burr};
    scene.tissues = {{.label = bone_label, .name = "bone"},
                     {.label = implant_label, .name = "implant", .is_cuttable = false}};
    scene.start_pose = {{0.0, 0.0, 2.5}, {0.0, 0.0, 1.0}};
    scene.trajectory = {
        .source = BuiltInTrajectory::cavity, .speed_mm_per_s = 8.0, .depth_mm = 2.0, .width_mm = 3.0};
    return scene;
}

MillingSessionReport pressed(const Scene& scene, const std::string& force_model,
                             const std::string& coupling) {
    SimulatedDevice device(make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, 0), scene.device,
                           ArmModel{}, hand_model(Grip::firm));
    MillingSessionOptions options{.clock = ClockKind::virtual_time, .duration_s = 4.0};
    options.force_model = force_model;
    options.coupling = coupling_named(coupling);
    const auto session = std::make_unique<MillingSession>(scene, bone_on_implant(), device, options);
    const std::atomic<bool> never{false};
    session->run(never);
    return session->report();
}

TEST(UncutTissue, StaysAndHoldsTheBurrWithEveryForceModelAndCoupling) {
    const Burr ball{.name = "ball", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0};
    for (const ForceModelEntry& model : force_models())
        for (const char* coupling : {"implicit", "interpolate", "virtual-coupling"}) {
            if (!model.has_cutting_law && std::string(coupling) == "implicit") continue;
            const MillingSessionReport report = pressed(implant_scene(ball), model.name, coupling);
            const std::string what = std::string(model.name) + " with " + coupling;
            EXPECT_GT(report.removed_mm3[bone_label], 0.3) << what;
            EXPECT_EQ(report.removed_mm3[implant_label], 0.0) << what;
            EXPECT_LE(report.peak_force_n, 3.3 + 1e-9) << what;
            if (std::string(coupling) != "implicit") continue;
            EXPECT_GT(report.peak_force_n, 0.6) << "a hand that would be a millimetre beyond the wall";
            EXPECT_LT(report.most_energy_to_hand_mj, 1.0);
            for (const std::uint64_t count : report.fault_counts) EXPECT_EQ(count, 0U) << what;
        }
}

TEST(UncutTissue, HoldsAHeadThatIsNoBall) {
    const Burr cylinder{.name = "cylinder",
                        .diameter_mm = 2.0,
                        .head = usual_head(HeadShape::cylinder, 2.0, 4.0),
                        .spindle_rev_per_s = 500.0};
    const MillingSessionReport report = pressed(implant_scene(cylinder), "milling", "implicit");
    EXPECT_GT(report.removed_mm3[bone_label], 0.3);
    EXPECT_EQ(report.removed_mm3[implant_label], 0.0);
    EXPECT_GT(report.peak_force_n, 0.6);
    EXPECT_LT(report.most_energy_to_hand_mj, 1.0);
    for (const std::uint64_t count : report.fault_counts) EXPECT_EQ(count, 0U);
}

/// A screw of 3.5 mm that stands out of bone by 1 mm, and the depth to which an arm with 1.5 N/mm presses a
/// turning ball into its rim, at an angle about it.
double entered_at_the_rim_mm(double ball_radius_mm, double angle_rad) {
    constexpr double screw_radius_mm = 1.75;
    const Grid grid{.size_voxels = {80, 80, 32}, .spacing_mm = 0.1, .origin_mm = {-3.95, -3.95, -3.15}};
    const Bone bone =
        filled(BoneBuilder::homogeneous(grid, 1.0, true), grid, [&](const glm::ivec3& voxel) -> VoxelValues {
            const glm::dvec3 centre_mm = centre_of_voxel_mm(grid, voxel);
            if (centre_mm.z < 0.0 && std::hypot(centre_mm.x, centre_mm.y) < screw_radius_mm)
                return {.fraction = 255, .tissue = implant_label};
            if (centre_mm.z < implant_top_mm) return {.fraction = 255, .tissue = bone_label};
            return {.fraction = 0};
        });
    const Scene scene = implant_scene({.name = "ball", .diameter_mm = 2.0 * ball_radius_mm});
    MillingModel model(bone, scene.burrs, scene.tissues);
    const auto coupling = make_coupling(coupling_named("implicit"), {});
    ForgottenChanges changes;
    const auto latest = std::make_unique<MillingResult>();
    const glm::dvec3 outward(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const glm::dvec3 way = -glm::normalize(outward + glm::dvec3(0.0, 0.0, 1.0));
    glm::dvec3 hand_mm = screw_radius_mm * outward - (ball_radius_mm + 0.2) * way;
    glm::dvec3 burr_mm = hand_mm;
    double entered_mm = 0.0;
    for (int tick = -1; tick < 400; ++tick) {
        const double now_s = 0.001 * tick;
        model.step({.pose = {burr_mm, {0.0, 0.0, 1.0}}, .spindle_on = tick >= 0, .elapsed_s = 0.001}, now_s,
                   changes, *latest);
        if (tick < 0) continue;
        hand_mm += 0.006 * way;
        burr_mm =
            coupling->tick({.now_s = now_s, .pose = {hand_mm, {0.0, 0.0, 1.0}}, .spindle_on = true}, *latest)
                .burr_pose.position_mm;
        const double beside_mm = std::hypot(burr_mm.x, burr_mm.y) - screw_radius_mm;
        const double away_mm = std::hypot(std::max(beside_mm, 0.0), std::max(burr_mm.z, 0.0)) +
                               std::min(0.0, std::max(beside_mm, burr_mm.z));
        entered_mm = std::max(entered_mm, ball_radius_mm - away_mm);
    }
    return entered_mm;
}

TEST(UncutTissue, IsEnteredAtItsRimByATenthOfAMillimetreAtMost) {
    for (const double ball_radius_mm : {1.0, 1.5})
        for (const double angle_rad : {0.0, 0.37, 0.74, 1.11, 1.48}) {
            const double entered_mm = entered_at_the_rim_mm(ball_radius_mm, angle_rad);
            EXPECT_LT(entered_mm, 0.1) << ball_radius_mm << " mm at " << angle_rad;
            EXPECT_GT(entered_mm, -0.05) << "it is met";
        }
}

TEST(UncutTissue, ThatNobodyForbidsToCutIsCut) {
    Scene scene = implant_scene({.name = "ball", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0});
    scene.tissues[1].is_cuttable = true;
    EXPECT_GT(pressed(scene, "milling", "implicit").removed_mm3[implant_label], 0.3);
}

}  // namespace
}  // namespace osteomill
