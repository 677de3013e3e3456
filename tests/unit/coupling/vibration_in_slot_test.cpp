// The vibration of a burr that mills a slot through voxels, beside the analytical reference's force within a
// turn of the spindle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/cutting_force/reference_force.h"
#include "simulation/force_models/milling_model.h"
#include "tests/support/block.h"
#include "tests/support/spectrum.h"

namespace osteomill::vibration_in_slot_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double tick_s = 0.001;
const glm::dvec3 up(0.0, 0.0, 1.0);

struct Slot {
    Burr burr;
    double depth_mm = 1.0;
    glm::dvec3 velocity_mm_per_s{6.0, 0.0, 0.0};
};

Slot slot_of(int edges, double rev_per_s, double run_out_mm) {
    return {.burr = {.name = "3 mm",
                     .diameter_mm = 3.0,
                     .edges = edges,
                     .spindle_rev_per_s = rev_per_s,
                     .edge_coefficients_n_per_mm = {0.3, 0.3, 0.0},
                     .run_out_mm = run_out_mm}};
}

/// On rails, with no limit of a device; the last half second.
std::vector<glm::dvec3> vibration_n(const Slot& slot) {
    const glm::dvec3 start_mm(-3.0, 0.017, slot.burr.radius_mm() - slot.depth_mm);
    MillingModel model(testing::make_block({-6.0, -3.0, -2.0}, {6.0, 3.0, 0.0}, 0.1), {slot.burr}, {});
    HandpieceVibration vibration({slot.burr}, {.max_force_n = 1e3, .max_slew_n_per_s = 1e6});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    std::vector<glm::dvec3> forces_n;
    for (int tick = 1; tick <= 1000; ++tick) {
        const double time_s = tick_s * tick;
        const ToolPose pose{start_mm + slot.velocity_mm_per_s * time_s, up};
        model.step({.pose = pose, .spindle_on = true, .elapsed_s = tick_s}, time_s, changes, *result);
        const glm::dvec3 force_n =
            vibration.tick({.now_s = time_s, .tick_s = tick_s, .pose = pose, .spindle_on = true}, *result,
                           result->force_n, true);
        if (tick > 500) forces_n.push_back(force_n);
    }
    return forces_n;
}

/// Root of the sum over the axes of the squared amplitude of the sine that a force makes `order` times a
/// turn.
double amplitude_n(int order, const std::function<glm::dvec3(double turned_rad)>& force_n) {
    constexpr int angles = 180;
    double sum_of_squares = 0.0;
    std::array<std::complex<double>, 3> sums{};
    for (int i = 0; i < angles; ++i) {
        const double turned_rad = two_pi * i / angles;
        const glm::dvec3 force = force_n(turned_rad);
        for (int axis = 0; axis < 3; ++axis)
            sums[static_cast<std::size_t>(axis)] +=
                force[axis] * std::polar(2.0 / angles, -order * turned_rad);
    }
    for (const std::complex<double>& sum : sums) sum_of_squares += std::norm(sum);
    return std::sqrt(sum_of_squares);
}

study::SteadyMotion motion_of(const Slot& slot) {
    return {.burr = slot.burr,
            .position_mm = {0.0, 0.0, slot.burr.radius_mm() - slot.depth_mm},
            .spindle_axis = up,
            .velocity_mm_per_s = slot.velocity_mm_per_s};
}

TEST(VibrationInASlot, OfTheEdgesIsTheReferences) {
    for (const int edges : {2, 3}) {
        const Slot slot = slot_of(edges, 240.0 / edges, 0.0);
        const double expected_n = amplitude_n(edges, [&](double turned_rad) {
            return study::instantaneous_reference_force_n(motion_of(slot), study::flat_bone(), turned_rad);
        });
        EXPECT_NEAR(testing::amplitude_at(vibration_n(slot), 240.0) / expected_n, 1.0, 0.05) << edges;
    }
}

TEST(VibrationInASlot, OfRunOutIsTheReferences) {
    const Slot slot = slot_of(6, 150.0, 0.004);
    const study::SteadyMotion motion = motion_of(slot);
    // An edge that is fed along itself takes a chip that is thicker by the same amount all round. Bone is
    // only in front of the burr.
    const double thicker_mm = slot.burr.run_out_mm * std::sin(std::numbers::pi / slot.burr.edges);
    const auto of_one_edge = [&](double angle_rad) {
        study::SteadyMotion one = motion;
        one.burr.edges = 1;
        one.burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
        one.velocity_mm_per_s = thicker_mm * slot.burr.spindle_rev_per_s *
                                glm::dvec3(std::cos(angle_rad), slot.burr.sigma() * std::sin(angle_rad), 0.0);
        return study::instantaneous_reference_force_n(
            one,
            [&](const glm::dvec3& at_mm) {
                return at_mm.z <= 0.0 && glm::dot(at_mm - motion.position_mm, motion.velocity_mm_per_s) > 0.0
                           ? 1.0
                           : 0.0;
            },
            angle_rad);
    };
    const double expected_n = amplitude_n(1, [&](double turned_rad) {
        glm::dvec3 force_n(0.0);
        for (int i = 0; i < slot.burr.edges; ++i) {
            const double ahead_rad = two_pi * i / slot.burr.edges;
            force_n += std::cos(ahead_rad) * of_one_edge(turned_rad + ahead_rad);
        }
        return force_n;
    });
    EXPECT_NEAR(testing::amplitude_at(vibration_n(slot), 150.0) / expected_n, 1.0, 0.05);
}

}  // namespace
}  // namespace osteomill::vibration_in_slot_test
