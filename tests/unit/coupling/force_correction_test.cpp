#include "simulation/coupling/force_correction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteomill::force_correction_test {
namespace {

const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
constexpr double tick_s = 0.001;

/// The corrected prediction, once the correction has followed the force of `model`, for steps of so many
/// ticks.
template <typename Model>
glm::dvec3 corrected(const glm::dvec3& predicted_n, Model&& model, int ticks_per_step,
                     double model_step_s = 0.0) {
    ForceCorrection correction;
    double time_s = 0.0;
    for (int step = 0; step < 2000 / ticks_per_step; ++step) {
        for (int tick = 0; tick < ticks_per_step; ++tick)
            correction.add_prediction(correction.gain() * predicted_n, tick_s);
        time_s += model_step_s > 0.0 ? model_step_s : ticks_per_step * tick_s;
        correction.compare(model(predicted_n), time_s, axis);
    }
    return correction.gain() * predicted_n;
}

TEST(ForceCorrection, FindsAStretchAndATurnAboutTheSpindleAndAnotherStretchAlongIt) {
    const auto model = [](const glm::dvec3& p) {
        const glm::dvec3 along = glm::dot(p, axis) * axis;
        return 0.95 * (p - along) + 0.03 * glm::cross(axis, p) + 1.2 * along;
    };
    const glm::dvec3 predicted_n(0.4, -1.1, 0.7);
    const glm::dvec3 found_n = corrected(predicted_n, model, 1);
    EXPECT_LT(glm::distance(found_n, model(predicted_n)), 1e-3 * glm::length(predicted_n));
}

TEST(ForceCorrection, ComparesImpulsesWhereTicksAndStepsDoNotDivide) {
    // Three ticks of prediction, a model force over 3.333 ms that removed the same bone.
    const auto model = [](const glm::dvec3& p) { return p * (3.0 / (10.0 / 3.0)); };
    const glm::dvec3 predicted_n(0.0, 1.0, 0.2);
    const glm::dvec3 found_n = corrected(predicted_n, model, 3, 0.01 / 3.0);
    EXPECT_LT(glm::distance(found_n, predicted_n), 1e-3);
}

TEST(ForceCorrection, LeavesAForceAloneThatIsTooSmallToJudge) {
    const glm::dvec3 predicted_n(0.0, 1e-5, 0.0);
    const glm::dvec3 found_n = corrected(
        predicted_n, [](const glm::dvec3& p) { return 3.0 * p; }, 1);
    EXPECT_NEAR(glm::length(found_n), 1e-5, 1e-7);
}

TEST(ForceCorrection, StaysWithinItsBoundsWhateverTheModelSays) {
    const glm::dvec3 predicted_n(0.0, 1.0, 0.0);
    const glm::dvec3 found_n = corrected(
        predicted_n, [](const glm::dvec3& p) { return -20.0 * p; }, 1);
    EXPECT_NEAR(glm::dot(found_n, predicted_n), 0.5, 0.05);
}

TEST(ForceCorrection, SoonForgetsHowAContactBegan) {
    // At first touch the map may be twice too stiff, and is right some ticks later.
    ForceCorrection correction;
    const glm::dvec3 predicted_n(0.0, 1.0, 0.0);
    double time_s = 0.0;
    const auto tick = [&](double times_too_stiff) {
        correction.add_prediction(correction.gain() * predicted_n, tick_s);
        correction.compare(predicted_n / times_too_stiff, time_s += tick_s, axis);
        return glm::length(correction.gain() * predicted_n);
    };
    for (int i = 0; i < 4; ++i) tick(2.0);
    EXPECT_NEAR(tick(2.0), 0.5, 0.05);
    for (int i = 0; i < 5; ++i) tick(1.0);
    EXPECT_NEAR(tick(1.0), 1.0, 0.05);
    for (int i = 0; i < 1000; ++i) tick(1.0);
    EXPECT_GT(tick(2.0), 0.95) << "a contact that lasts is followed slowly";
}

TEST(ForceCorrection, ForgetsInTheAirWhatItLearntInBone) {
    ForceCorrection correction;
    const glm::dvec3 predicted_n(0.0, 1.0, 0.0);
    double time_s = 0.0;
    const auto tick = [&](const glm::dvec3& predicted, const glm::dvec3& model_n) {
        correction.add_prediction(correction.gain() * predicted, tick_s);
        correction.compare(model_n, time_s += tick_s, axis);
    };
    for (int i = 0; i < 1000; ++i) tick(predicted_n, 0.6 * predicted_n);
    ASSERT_LT(glm::length(correction.gain() * predicted_n), 0.7);
    for (int i = 0; i < 15; ++i) tick(glm::dvec3(0.0), glm::dvec3(0.0));
    EXPECT_LT(glm::length(correction.gain() * predicted_n), 0.7) << "a burr that only skips over a gap";
    for (int i = 0; i < 6; ++i) tick(glm::dvec3(0.0), glm::dvec3(0.0));
    EXPECT_EQ(correction.gain(), glm::dmat3(1.0));
    for (int i = 0; i < 1000; ++i) tick(predicted_n, 1.2 * predicted_n);
    EXPECT_NEAR(glm::length(correction.gain() * predicted_n), 1.2, 1e-3) << "and learns anew";
}

}  // namespace
}  // namespace osteomill::force_correction_test
