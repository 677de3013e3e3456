// Whether a measurement finds what an arm is, for arms, hands, noises and delays that nothing was tuned to
// (the thresholds of haptic_server/measuring were chosen on other seeds).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

#include "haptic_server/measuring/arm_estimates.h"
#include "haptic_server/measuring/arm_shake.h"
#include "haptic_server/measuring/stiffness_ramp.h"
#include "simulation/device/arm_spring.h"
#include "simulation/device/measured_arm.h"
#include "tests/support/bench/fine_arm.h"

namespace osteomill::testing {
namespace {

constexpr unsigned judged_seed = 2027;
constexpr int arms = 40;
constexpr double damping_n_s_per_mm = 0.004;

/// Whether a tap dies on a spring of this stiffness, without tremor: the swing of the third second after it
/// is under `felt_mm`, or smaller than that of the second.
bool comes_to_rest(FineFigures figures, double stiffness_n_per_mm, double resolution_mm, double felt_mm) {
    figures.tremor_mm = 0.0;
    FineArm arm(figures, 7);
    PositionObserver observer(resolution_mm);
    const glm::dvec3 place_mm = arm.read(0.0).position_mm;
    glm::dvec3 before_mm = place_mm;
    glm::dvec3 velocity_mm_per_s(0.0);
    double low_mm[3] = {1e9, 1e9, 1e9};
    double high_mm[3] = {-1e9, -1e9, -1e9};
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 at_mm = observer.update(arm.read(1e-3 * i).position_mm, 1e-3);
        velocity_mm_per_s +=
            1e-3 / (ArmSpring::hand_filter_s + 1e-3) * ((at_mm - before_mm) / 1e-3 - velocity_mm_per_s);
        before_mm = at_mm;
        glm::dvec3 force_n =
            -stiffness_n_per_mm * (at_mm - place_mm) - damping_n_s_per_mm * velocity_mm_per_s;
        if (i < 20)
            force_n += glm::dvec3(figures.held().mass_kg * 0.03 / 0.02 + figures.arm.coulomb_friction_n);
        arm.write(force_n);
        const double x_mm = arm.position_mm(0);
        if (std::abs(x_mm) > 20.0) return false;
        low_mm[i / 1000] = std::min(low_mm[i / 1000], x_mm);
        high_mm[i / 1000] = std::max(high_mm[i / 1000], x_mm);
    }
    const double after_mm = high_mm[2] - low_mm[2];
    return after_mm < felt_mm || after_mm < 0.7 * (high_mm[1] - low_mm[1]);
}

double stiffest_calm_n_per_mm(const FineFigures& figures, double resolution_mm, double felt_mm) {
    double calm = StiffnessRamp::softest_n_per_mm;
    while (calm < StiffnessRamp::stiffest_n_per_mm &&
           comes_to_rest(figures, 1.08 * calm, resolution_mm, felt_mm))
        calm *= 1.08;
    return std::min(calm, StiffnessRamp::stiffest_n_per_mm);
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

TEST(RandomArms, AreFoundAsTheyAre) {
    std::mt19937 random(judged_seed);
    std::vector<double> mass, friction_n, delay_ticks, step_mm, noise_mm, calm, calm_without_friction;
    for (int i = 0; i < arms; ++i) {
        const FineFigures figures = random_arm(random);
        FineArm arm(figures, judged_seed * 1000 + static_cast<unsigned>(i));
        ArmShake shake(3.3);
        double now_s = 0.0;
        for (; !shake.is_over(); now_s += 1e-3) arm.write(shake.tick(arm.read(now_s), now_s));
        ASSERT_EQ(shake.end(), MeasuringEnd::done) << i << ": " << text_of(shake.end());
        const double found_step_mm = encoder_step_mm(shake.all());
        const double found_noise_mm = reading_noise_mm(shake.rest());
        const double resolution_mm =
            MeasuredArm{.step_mm = found_step_mm, .noise_mm = found_noise_mm}.resolution_mm();
        step_mm.push_back(std::abs(found_step_mm - figures.step_mm));
        if (figures.step_mm == 0.0) noise_mm.push_back(std::abs(found_noise_mm - figures.noise_mm));
        RampedArm known{.damping_n_s_per_mm = damping_n_s_per_mm,
                        .resolution_mm = resolution_mm,
                        .noise_mm = found_noise_mm,
                        .moving_mass_kg = 10.0,
                        .friction_n = 10.0,
                        .sway_mm = sway_mm(shake.rest())};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = pushed_motion(shake.push(k), k, found_step_mm);
            ASSERT_TRUE(found) << i;
            mass.push_back(std::abs(found->mass_kg / figures.held().mass_kg - 1.0));
            friction_n.push_back(std::abs(found->friction_n - figures.arm.coulomb_friction_n));
            delay_ticks.push_back(std::abs(found->delay_ticks - figures.delay_ticks));
            known.moving_mass_kg = std::min(known.moving_mass_kg, found->mass_kg);
            known.friction_n = std::min(known.friction_n, found->friction_n);
            known.delay_ticks = std::max(known.delay_ticks, found->delay_ticks);
        }
        StiffnessRamp ramp(known, shake.guard().again());
        for (; !ramp.is_over(); now_s += 1e-3) arm.write(ramp.tick(arm.read(now_s), now_s));
        ASSERT_TRUE(ramp.swinging_n_per_mm() > 0.0 || ramp.end() == MeasuringEnd::done) << i;
        // As much as the ramp takes for a swing: rms to peak to peak.
        const double felt_mm =
            2.83 * std::max({resolution_mm, 4.0 * known.noise_mm, 0.02, 1.5 * known.sway_mm});
        const double truth = stiffest_calm_n_per_mm(figures, resolution_mm, felt_mm);
        (figures.arm.coulomb_friction_n > 0.0 ? calm : calm_without_friction)
            .push_back(ramp.calm_n_per_mm() / truth);
        const DeviceLimits given = with_measured_spring(arm.limits(), 0.0,
                                                        {.calm_n_per_mm = ramp.calm_n_per_mm(),
                                                         .damping_n_s_per_mm = damping_n_s_per_mm,
                                                         .step_mm = found_step_mm,
                                                         .noise_mm = found_noise_mm,
                                                         .delay_s = 1e-3 * known.delay_ticks,
                                                         .moving_mass_kg = known.moving_mass_kg,
                                                         .friction_n = known.friction_n});
        if (figures.arm.coulomb_friction_n > 0.0) {
            EXPECT_LT(given.max_stiffness_n_per_mm, truth) << i << ": the spring that this arm would get";
        }
        std::printf(
            "%2d: %3.0f g + %3.0f g, %.2f N, step %.3f, noise %.4f, %.1f late, tremor %.2f: calm %.2f, truth "
            "%.2f\n",
            i, 1e3 * figures.arm.mass_kg, 1e3 * figures.hand_kg, figures.arm.coulomb_friction_n,
            figures.step_mm, figures.noise_mm, figures.delay_ticks, figures.tremor_mm, ramp.calm_n_per_mm(),
            truth);
    }
    const auto said = [](const char* what, const std::vector<double>& values) {
        std::printf("%s: median %.3f, 90 %% %.3f, worst %.3f\n", what, quantile(values, 0.5),
                    quantile(values, 0.9), quantile(values, 1.0));
    };
    said("mass, share off", mass);
    said("friction, N off", friction_n);
    said("delay, ticks off", delay_ticks);
    said("step, mm off", step_mm);
    said("noise, mm off", noise_mm);
    const auto said_shares = [](const char* what, const std::vector<double>& values) {
        std::printf("%s: least %.2f, 10 %% %.2f, median %.2f, 90 %% %.2f, most %.2f\n", what,
                    quantile(values, 0.0), quantile(values, 0.1), quantile(values, 0.5),
                    quantile(values, 0.9), quantile(values, 1.0));
    };
    said_shares("calm / truth", calm);
    said_shares("calm / truth, without friction", calm_without_friction);
    EXPECT_LT(quantile(mass, 0.9), 0.05);
    EXPECT_LT(quantile(mass, 1.0), 0.15);
    EXPECT_LT(quantile(friction_n, 0.9), 0.05);
    EXPECT_LT(quantile(friction_n, 1.0), 0.12);
    EXPECT_LT(quantile(delay_ticks, 0.9), 0.25);
    EXPECT_LT(quantile(delay_ticks, 1.0), 0.6);
    EXPECT_LT(quantile(step_mm, 0.9), 0.002);
    EXPECT_LT(quantile(noise_mm, 1.0), 0.002);
    EXPECT_LT(quantile(calm, 0.9), 1.2);
    EXPECT_LT(quantile(calm, 1.0), 1.5) << "an arm gets two thirds";
    EXPECT_GT(quantile(calm, 0.1), 0.75);
    EXPECT_GT(quantile(calm, 0.0), 0.4);
    // No real arm is without friction: it hunts about the steps of its encoders, with swings that a hand's
    // sway hides.
    EXPECT_GT(quantile(calm_without_friction, 0.0), 0.4);
}

}  // namespace
}  // namespace osteomill::testing
