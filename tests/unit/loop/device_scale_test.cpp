// Sessions with one and the same arm, whose millimetre is as much as a hundredth or a hundred of the
// patient's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/device_mapping.h"
#include "devices/simulated/simulated_device.h"
#include "simulation/coupling/couplings.h"
#include "simulation/loop/milling_session.h"
#include "tests/support/block.h"

namespace osteomill::device_scale_test {
namespace {

constexpr std::array scales{0.01, 0.03, 0.1, 0.3, 0.5, 1.0, 2.0, 4.0, 10.0, 30.0, 100.0};
const glm::dvec3 up(0.0, 0.0, 1.0);

/// The hand goes here, mm at the arm from where the burr touches the top of the bone at z = 0.
struct Way {
    double time_s;
    glm::dvec3 at_arm_mm;
};

/// A tick at the arm.
struct Pressed {
    double force_n;
    double depth_mm;
};

/// An arm that records the forces written to it.
class NotingArm final : public HapticDevice {
  public:
    NotingArm(const std::vector<Way>& ways, bool pedal, const Scene& scene)
        : arm_(trajectory(ways, pedal, scene), scene.device, ArmModel{}, hand_model(Grip::firm)) {}

    std::string name() const override { return arm_.name(); }
    DeviceLimits limits() const override { return arm_.limits(); }
    void start() override {}
    DeviceState read(double now_s) noexcept override { return arm_.read(now_s); }
    void write(const glm::dvec3& force_n) noexcept override {
        largest_jump_n = std::max(largest_jump_n, glm::distance(force_n, last_n));
        last_n = force_n;
        trace.push_back({force_n.z, -arm_.held_arm().truth().position_mm().z});
        arm_.write(force_n);
    }
    void stop() noexcept override {}

    double largest_jump_n = 0.0;
    glm::dvec3 last_n{0.0};
    std::vector<Pressed> trace;

  private:
    static Trajectory trajectory(const std::vector<Way>& ways, bool pedal, const Scene& scene) {
        std::vector<Waypoint> waypoints;
        for (const Way& way : ways)
            waypoints.push_back(
                {way.time_s, {position_in_patient_mm(scene.device, way.at_arm_mm), up}, pedal, std::nullopt});
        return Trajectory(waypoints);
    }

    SimulatedDevice arm_;
};

Scene scene_of(double scale, double burr_mm) {
    Scene scene;
    scene.burrs = {{.name = "ball", .diameter_mm = burr_mm, .spindle_rev_per_s = 500.0}};
    scene.device = {.scale = scale, .offset_mm = {0.031, 0.017, 0.5 * burr_mm}};
    return scene;
}

struct Felt {
    MillingSessionReport report;
    double largest_jump_n = 0.0;
    std::vector<Pressed> trace;
};

Felt run(const std::string& coupling, double scale, const std::vector<Way>& ways, bool pedal) {
    Scene scene = scene_of(scale, 2.0);
    scene.start_pose = {position_in_patient_mm(scene.device, ways.front().at_arm_mm), up};
    NotingArm arm(ways, pedal, scene);
    const auto session = std::make_unique<MillingSession>(
        scene, testing::make_block({-8.0, -4.0, -3.2}, {8.0, 4.0, 0.0}, 0.1), arm,
        MillingSessionOptions{.clock = ClockKind::virtual_time,
                              .coupling = coupling_named(coupling),
                              .duration_s = ways.back().time_s});
    const std::atomic<bool> never{false};
    session->run(never);
    return {session->report(), arm.largest_jump_n, arm.trace};
}

void expect_calm(const Felt& felt, const std::string& what) {
    EXPECT_LE(felt.largest_jump_n, 0.3) << what;
    for (const std::uint64_t count : felt.report.fault_counts) EXPECT_EQ(count, 0U) << what;
    EXPECT_LT(felt.report.most_energy_to_hand_mj, 5.0) << what;
}

TEST(DeviceScale, LeavesTheArmAllOfItsStiffnessOnAWallWithEveryCoupling) {
    // A touch of 10 mm/s, then first a little, then far into the bone.
    const std::vector<Way> press{{0.0, {0.0, 0.0, 0.5}},  {0.05, {0.0, 0.0, 0.5}},  {0.2, {0.0, 0.0, -1.0}},
                                 {0.6, {0.0, 0.0, -1.0}}, {0.75, {0.0, 0.0, -3.0}}, {1.2, {0.0, 0.0, -3.0}}};
    for (const CouplingEntry& coupling : couplings())
        for (const double scale : scales) {
            const std::string what = coupling.name + " at " + std::to_string(scale);
            const Felt felt = run(coupling.name, scale, press, false);
            expect_calm(felt, what);
            const Pressed& lightly = felt.trace.at(600);
            const Pressed& hard = felt.trace.back();
            ASSERT_GT(hard.depth_mm - lightly.depth_mm, 0.1) << what;
            const double felt_n_per_mm =
                (hard.force_n - lightly.force_n) / (hard.depth_mm - lightly.depth_mm);
            const double spring_n_per_mm = limits_of(ArmModel{}).max_stiffness_n_per_mm;
            EXPECT_LT(felt_n_per_mm, 1.2 * spring_n_per_mm) << what << ", and it still creeps";
            // The bone gives way, too: under a microscope the burr presses on a few patches.
            EXPECT_GT(felt_n_per_mm, (scale < 0.1 ? 0.77 : 0.9) * spring_n_per_mm) << what;
        }
}

TEST(DeviceScale, CutsCalmlyWithTheCouplingsThatAreSolvedWithTheBone) {
    // Down by 0.6 mm of the patient at 2 mm/s, and along; a hand moves the arm by no more than some mm.
    for (const double scale : scales) {
        const double mm = std::min(1.0, 3.0 / scale);
        const std::vector<Way> cut{{0.0, {0.0, 0.0, 0.3 * mm}},
                                   {0.05, {0.0, 0.0, 0.3 * mm}},
                                   {0.5, {0.0, 0.0, -0.6 * mm}},
                                   {1.2, {1.4 * mm, 0.3 * mm, -0.6 * mm}},
                                   {1.6, {1.4 * mm, 0.3 * mm, 0.5 * mm}}};
        for (const char* coupling : {"implicit", "virtual-coupling"}) {
            const Felt felt = run(coupling, scale, cut, true);
            const std::string what = std::string(coupling) + " at " + std::to_string(scale);
            expect_calm(felt, what);
            EXPECT_LT(felt.report.solve.max_residual_n, 1e-3) << what;
            EXPECT_EQ(felt.report.solve.relaxed, 0U) << what;
        }
    }
}

}  // namespace
}  // namespace osteomill::device_scale_test
