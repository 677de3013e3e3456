#include "simulation/coupling/position_observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace osteomill::position_observer_test {
namespace {

constexpr double step_mm = 0.055;
constexpr double tick_s = 0.001;

double quantised(double x) {
    return step_mm * std::round(x / step_mm);
}

TEST(PositionObserver, GlidesWhereTheEncoderSteps) {
    PositionObserver observer(step_mm);
    double largest_step = 0.0;
    double before = 0.0;
    for (int tick = 0; tick < 2000; ++tick) {
        const double true_mm = 4.0 * tick_s * tick;  // 4 mm/s: a step of the encoder every 14 ticks
        const double estimate = observer.update({quantised(true_mm), 0.0, 0.0}, tick_s).x;
        EXPECT_LE(std::abs(estimate - quantised(true_mm)), 0.5 * step_mm + 1e-12) << "never leaves the cell";
        if (tick > 200) largest_step = std::max(largest_step, std::abs(estimate - before));
        before = estimate;
    }
    EXPECT_LT(largest_step, 0.25 * step_mm);
}

TEST(PositionObserver, TurnsAStepThatItDidNotExpectIntoAGlideWhereBoneIsCut) {
    PositionObserver observer(step_mm);
    observer.update({0.0, 0.0, 0.0}, tick_s, false);
    double before = 0.0;
    for (int tick = 0; tick < 100; ++tick) {
        const double estimate = observer.update({step_mm, 0.0, 0.0}, tick_s, false).x;
        EXPECT_LT(std::abs(estimate - before), 0.15 * step_mm) << tick;
        before = estimate;
    }
    EXPECT_NEAR(before, step_mm, 0.5 * step_mm);
}

TEST(PositionObserver, FollowsAFastHandByAStepAndAHalf) {
    PositionObserver observer(step_mm);
    observer.update({0.0, 0.0, 0.0}, tick_s, false);
    for (int tick = 1; tick < 1000; ++tick) {
        const double true_mm = 5.0 * std::sin(0.03 * tick);  // 150 mm/s, 5 Hz
        const double estimate = observer.update({quantised(true_mm), 0.0, 0.0}, tick_s, false).x;
        EXPECT_LE(std::abs(estimate - quantised(true_mm)), 1.5 * step_mm + 1e-12) << tick;
    }
}

TEST(PositionObserver, ComesToRestWithTheHand) {
    PositionObserver observer(step_mm);
    for (int tick = 0; tick < 500; ++tick) observer.update({quantised(0.004 * tick), 0.0, 0.0}, tick_s);
    double before = 0.0;
    for (int tick = 0; tick < 500; ++tick) before = observer.update({quantised(2.0), 0.0, 0.0}, tick_s).x;
    EXPECT_NEAR(observer.update({quantised(2.0), 0.0, 0.0}, tick_s).x, before, 1e-4);
    EXPECT_NEAR(before, quantised(2.0), 0.5 * step_mm + 1e-12);
}

TEST(PositionObserver, ComesToAHandThatStandsStillHoweverItCame) {
    for (const double mm_per_s : {0.5, 1.0, 3.0, 20.0, -20.0}) {
        for (const bool is_exact : {false, true}) {  // as a hand on rails is read
            for (const bool on_wall : {false, true}) {
                PositionObserver observer(step_mm);
                const auto read = [&](double x) { return is_exact ? x : quantised(x); };
                double estimate = 0.0;
                for (int tick = 0; tick < 3000; ++tick) {
                    const double true_mm = mm_per_s * tick_s * std::min(tick, 2000);
                    estimate = observer.update({read(true_mm), 0.0, 0.0}, tick_s, on_wall).x;
                }
                EXPECT_NEAR(estimate, read(mm_per_s * 2.0), 0.05 * step_mm) << mm_per_s;
            }
        }
    }
}

TEST(PositionObserver, IsDrawnIntoTheCell) {
    PositionObserver observer(step_mm);
    observer.update({0.0, 0.0, 0.0}, tick_s);
    const double reading_mm = 0.6 * step_mm;  // a tenth of a step outside
    EXPECT_NEAR(observer.update({reading_mm, 0.0, 0.0}, tick_s).x, 0.1 * step_mm, 0.04 * step_mm)
        << "enters at the edge";
    double estimate = 0.0;
    for (int tick = 0; tick < 400; ++tick) estimate = observer.update({reading_mm, 0.0, 0.0}, tick_s).x;
    EXPECT_NEAR(estimate, reading_mm, 0.1 * step_mm) << "v tau = 0.05 x 0.1 q / T x 20 T";
}

TEST(PositionObserver, WithoutQuantisationIsTheReading) {
    PositionObserver observer(0.0);
    for (const double x : {0.0, 1.0, -3.5, 100.0})
        EXPECT_EQ(observer.update({x, 2.0 * x, 0.0}, tick_s), glm::dvec3(x, 2.0 * x, 0.0));
}

TEST(PositionObserver, StartsAnewAfterAReset) {
    PositionObserver observer(step_mm);
    for (int tick = 0; tick < 100; ++tick) observer.update({0.055 * tick, 0.0, 0.0}, tick_s);
    observer.reset();
    EXPECT_EQ(observer.update({-8.0, 1.0, 2.0}, tick_s), glm::dvec3(-8.0, 1.0, 2.0));
}

}  // namespace
}  // namespace osteomill::position_observer_test
