// A hand that sinks into real bone while the device is lost, and its force by every coupling and force model
// when the device is back: none until it has lifted the burr out, and then a wall that pushes out.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "simulation/force_models/force_models.h"
#include "simulation/loop/milling_session.h"
#include "tests/support/block.h"
#include "tests/unit/loop/scripted_parts.h"

namespace osteomill {
namespace {

constexpr double radius_mm = 1.0;
constexpr double pressed_mm = 0.3;
/// Bone that may be left in a burr that counts as clear: a voxel.
constexpr double overlap_mm = 0.1;
/// The force with which a damper, a virtual tool's mass or a filter may still pull when the hand turns.
constexpr double most_pull_n = 0.05;

struct SunkCase {
    std::string name;
    double sunk_mm = 0.0;  ///< below where it pressed
    std::string coupling = "implicit";
    std::string force_model = force_model_names().front();
};

/// A straight line between heights at times.
double height_mm(double t_s, double sunk_mm) {
    const double pressed = radius_mm - pressed_mm;
    const double above = radius_mm + 0.6;
    const std::vector<std::pair<double, double>> way{{0.0, above},
                                                     {0.2, pressed},
                                                     {0.25, pressed},
                                                     {0.4, pressed - sunk_mm},
                                                     {0.6, pressed - sunk_mm},
                                                     {0.9, above},
                                                     {1.35, above},
                                                     {1.5, pressed},
                                                     {9.0, pressed}};
    std::size_t i = 1;
    while (way[i].first < t_s) ++i;
    const double share = (t_s - way[i - 1].first) / (way[i].first - way[i - 1].first);
    return std::lerp(way[i - 1].second, way[i].second, share);
}

bool is_lost(double t_s) {
    return t_s >= 0.25 && t_s < 0.4;
}

class SunkBurr : public ::testing::TestWithParam<SunkCase> {};

TEST_P(SunkBurr, IsFeltAgainOnlyWhenItHasBeenLiftedOutAndNeverPullsDeeper) {
    const SunkCase& sunk = GetParam();
    Scene scene;
    scene.burrs = {{.name = "2 mm", .diameter_mm = 2.0 * radius_mm, .spindle_rev_per_s = 500.0}};
    scene.start_pose = {{0.0, 0.0, height_mm(0.0, 0.0)}, {0.0, 0.0, 1.0}};
    testing::ScriptedDevice device;
    device.script = [&](double t_s) {
        // A little sideways, and the pedal down all the time that it is back in the bone.
        return DeviceState{.position_mm = {std::max(0.0, t_s - 0.3), 0.0, height_mm(t_s, sunk.sunk_mm)},
                           .pedal = {t_s > 0.3 && t_s < 0.6},
                           .connected = !is_lost(t_s)};
    };
    const Bone block = testing::make_block({-4.0, -4.0, -6.4}, {4.0, 4.0, 0.0}, 0.1);
    const auto session =
        std::make_unique<MillingSession>(scene, block, device,
                                         MillingSessionOptions{.clock = ClockKind::virtual_time,
                                                               .coupling = coupling_named(sunk.coupling),
                                                               .force_model = sunk.force_model,
                                                               .duration_s = 1.6});
    session->run(std::atomic<bool>{false});

    EXPECT_EQ(session->report().bone_checksum, checksum(block)) << "nothing was cut";
    EXPECT_GT(device.written_n[245].z, 0.02) << "the wall was felt";
    for (std::size_t i = 250; i < device.written_n.size(); ++i) {
        const double t_s = MillingSession::tick_s * static_cast<double>(i);
        ASSERT_GE(device.written_n[i].z, -most_pull_n) << "pulled deeper at " << t_s << " s";
        const bool has_faded = t_s > 0.25 + ForceGuard::fade_out_s + 0.002;
        if (has_faded && t_s < 1.0 && height_mm(t_s, sunk.sunk_mm) < radius_mm - overlap_mm) {
            ASSERT_EQ(device.written_n[i], glm::dvec3(0.0)) << "in the bone at " << t_s << " s";
        }
    }
    EXPECT_GT(device.written_n.back().z, 0.02) << "the wall is felt again";
}

std::vector<SunkCase> sunk_cases() {
    std::vector<SunkCase> cases{{"ALittle", 0.3}, {"HalfTheBurr", 1.2}};
    constexpr double buried_mm = 2.9;
    for (const CouplingEntry& coupling : couplings()) {
        std::string name = "Buried_" + coupling.name;
        std::erase(name, '-');
        cases.push_back({name, buried_mm, coupling.name});
    }
    for (const ForceModelEntry& model : force_models()) {
        if (model.has_cutting_law) continue;
        std::string name = "Buried_" + model.name;
        std::erase(name, '-');
        cases.push_back({name, buried_mm, "interpolate", model.name});
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(EveryCouplingAndModel, SunkBurr, ::testing::ValuesIn(sunk_cases()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace osteomill
