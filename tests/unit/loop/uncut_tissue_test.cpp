// A hand presses a turning burr through bone onto tissue that no burr cuts.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "common/bone/bone_builder.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/force_models/force_models.h"
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

TEST(UncutTissue, ThatNobodyForbidsToCutIsCut) {
    Scene scene = implant_scene({.name = "ball", .diameter_mm = 2.0, .spindle_rev_per_s = 500.0});
    scene.tissues[1].is_cuttable = true;
    EXPECT_GT(pressed(scene, "milling", "implicit").removed_mm3[implant_label], 0.3);
}

}  // namespace
}  // namespace osteomill
