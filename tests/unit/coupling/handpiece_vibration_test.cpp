#include "simulation/coupling/handpiece_vibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "simulation/safety/force_guard.h"
#include "tests/support/spectrum.h"

namespace osteomill::handpiece_vibration_test {
namespace {

constexpr double tick_s = 0.001;
constexpr double feed_mm_per_s = 6.0;
constexpr double resistance_n_s_per_mm = 0.05;  // a patch's, as it advances along its normal
constexpr double mean_n = resistance_n_s_per_mm * feed_mm_per_s;

Burr burr_of(int edges, double rev_per_s, double run_out_mm) {
    return {.edges = edges, .spindle_rev_per_s = rev_per_s, .run_out_mm = run_out_mm};
}

/// A hand that feeds a burr along x through bone that resists as a damper.
class Cut {
  public:
    explicit Cut(const Burr& burr, double max_force_n = 3.3)
        : vibration_({burr}, {.max_force_n = max_force_n, .max_slew_n_per_s = ForceGuard::slew_n_per_s}) {
        face({0.0});
    }

    /// Patches at these azimuths from the feed, each with the same law. Their mean force is along the feed.
    void face(const std::vector<double>& azimuths_rad) {
        result_->engagement.count = azimuths_rad.size();
        mean_force_n_ = glm::dvec3(0.0);
        for (std::size_t i = 0; i < azimuths_rad.size(); ++i) {
            const glm::dvec3 normal(std::cos(azimuths_rad[i]), std::sin(azimuths_rad[i]), 0.0);
            result_->engagement.patches[i] = {.normal = normal,
                                              .cutting_n_s_per_mm = {-resistance_n_s_per_mm, 0.0, 0.0}};
            mean_force_n_.x -= resistance_n_s_per_mm * feed_mm_per_s * normal.x;
        }
    }
    void leave_bone() { face({}); }

    /// The hand goes `aside_mm` beside its feed.
    glm::dvec3 tick(const glm::dvec3& aside_mm = glm::dvec3(0.0)) {
        ++tick_;
        const glm::dvec3 path_mm(feed_mm_per_s * tick_s * tick_, 0.0, 0.0);
        result_->step = static_cast<std::uint64_t>(tick_);
        result_->time_s = tick_s * tick_;
        result_->spindle_on = true;
        result_->pose.position_mm = path_mm;
        result_->force_n = mean_force_n_;
        aside_mm_ += aside_mm;
        const HandState hand{.now_s = tick_s * tick_,
                             .tick_s = tick_s,
                             .pose = {path_mm + aside_mm_, {0.0, 0.0, 1.0}},
                             .spindle_on = spindle_on};
        given_mj_ += glm::dot(last_n_, feed_mm_per_s * tick_s * glm::dvec3(1.0, 0.0, 0.0) + aside_mm);
        taken_mj_ -= tick_ > 1 ? glm::dot(mean_force_n_, {feed_mm_per_s * tick_s, 0.0, 0.0}) : 0.0;
        return last_n_ = vibration_.tick(hand, *result_, mean_force_n_ + more_mean_n, is_felt);
    }
    std::vector<glm::dvec3> run(int ticks) {
        std::vector<glm::dvec3> forces_n;
        for (int i = 0; i < ticks; ++i) forces_n.push_back(tick());
        return forces_n;
    }

    const HandpieceVibration& vibration() const { return vibration_; }
    MillingResult& result() { return *result_; }
    /// Work of the vibration on the hand, and of the hand on the bone, so far.
    double given_mj() const { return given_mj_; }
    double taken_mj() const { return taken_mj_; }

    glm::dvec3 more_mean_n{0.0};  ///< from the coupling, not from the cut
    bool is_felt = true;
    bool spindle_on = true;

  private:
    HandpieceVibration vibration_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();
    glm::dvec3 mean_force_n_{0.0};
    int tick_ = 0;
    glm::dvec3 aside_mm_{0.0};
    glm::dvec3 last_n_{0.0};
    double given_mj_ = 0.0;
    double taken_mj_ = 0.0;
};

double largest(const std::vector<glm::dvec3>& forces_n) {
    double largest_n = 0.0;
    for (const glm::dvec3& force_n : forces_n) largest_n = std::max(largest_n, glm::length(force_n));
    return largest_n;
}

/// One sine of a frequency and an amplitude, and nothing else.
void expect_line(const std::vector<glm::dvec3>& forces_n, double frequency_hz, double amplitude_n) {
    EXPECT_NEAR(testing::amplitude_at(forces_n, frequency_hz), amplitude_n, 0.01 * amplitude_n);
    for (double hz = 1.0; hz <= 500.0; hz += 1.0) {
        if (std::abs(hz - frequency_hz) <= 3.0) continue;
        ASSERT_LT(testing::amplitude_at(forces_n, hz), 0.01 * amplitude_n) << hz << " Hz";
    }
}

TEST(HandpieceVibration, OfRunOutIsTheForceOfTheChipsThatItMakes) {
    Cut cut(burr_of(6, 150.0, 0.002));
    cut.run(500);
    // The chips are thicker and thinner by 0.002 mm sin(30 degrees), 900 of them a second.
    expect_line(cut.run(1000), 150.0, resistance_n_s_per_mm * 0.9);
}

TEST(HandpieceVibration, OfRunOutIsNoLargerThanTheMeanForceOfTheChips) {
    Cut cut(burr_of(6, 150.0, 0.05));
    cut.run(500);
    expect_line(cut.run(1000), 150.0, mean_n);

    Cut rubbing(burr_of(6, 150.0, 0.05));
    rubbing.result().engagement.patches[0].edge_n = {-0.5, 0.0, 0.0};
    rubbing.run(500);
    expect_line(rubbing.run(1000), 150.0, mean_n);
}

TEST(HandpieceVibration, TurnsWithTheSpindleWhereBoneIsAllAround) {
    // A damper that is alike in x and y: the force is of one size and goes round as the burr does.
    for (const SpindleSense sense : {SpindleSense::clockwise, SpindleSense::counter_clockwise}) {
        Burr burr = burr_of(64, 10.0, 0.02);
        burr.sense = sense;
        Cut cut(burr);
        cut.face({0.25 * std::numbers::pi, -0.25 * std::numbers::pi});
        for (std::size_t i = 0; i < 2; ++i)
            cut.result().engagement.patches[i].cutting_n_s_per_mm =
                -resistance_n_s_per_mm * cut.result().engagement.patches[i].normal;
        cut.run(500);
        const glm::dvec3 before_n = cut.tick();
        const glm::dvec3 after_n = cut.tick();
        EXPECT_GT(burr.sigma() * glm::cross(before_n, after_n).z, 0.0);
    }
}

TEST(HandpieceVibration, OfTheEdgesIsTheFourierComponentOfTheirPulses) {
    // Two patches 20 degrees off the feed: 2 (cos 80 + cos -80 degrees) of each one's mean force.
    Cut cut(burr_of(4, 50.0, 0.0));
    const double off_rad = std::numbers::pi / 9.0;
    cut.face({off_rad, -off_rad});
    cut.run(500);
    const double patch_n = mean_n * std::cos(off_rad);
    expect_line(cut.run(1000), 200.0, 4.0 * patch_n * std::cos(4.0 * off_rad));

    // All bone at one place: every edge strikes, but the force does not turn round.
    Cut narrow(burr_of(4, 50.0, 0.0));
    narrow.run(500);
    expect_line(narrow.run(1000), 200.0, mean_n);
}

TEST(HandpieceVibration, HasNothingAbove300Hz) {
    for (const double rev_per_s : {300.1, 333.0, 667.0, 1000.0, 80'000.0 / 60.0}) {
        Cut cut(burr_of(6, rev_per_s, 0.05));
        EXPECT_EQ(largest(cut.run(1000)), 0.0) << rev_per_s;
    }
    Cut turns(burr_of(5, 61.0, 0.001));
    turns.run(500);
    expect_line(turns.run(1000), 61.0,
                resistance_n_s_per_mm * 0.001 * std::sin(std::numbers::pi / 5.0) * 305.0);
}

TEST(HandpieceVibration, TellsWhichBurrsHaveAnyInReach) {
    EXPECT_TRUE(vibrates_in_reach(burr_of(6, 10'000.0 / 60.0, 0.02)));
    EXPECT_TRUE(vibrates_in_reach(burr_of(6, 50.0, 0.0)));
    EXPECT_FALSE(vibrates_in_reach(burr_of(6, 10'000.0 / 60.0, 0.0)));
    EXPECT_FALSE(vibrates_in_reach(burr_of(6, 40'000.0 / 60.0, 0.02)));
    EXPECT_TRUE(vibrates_in_reach(burr_of(1, 10'000.0 / 60.0, 0.0))) << "one edge, once a turn";
}

TEST(HandpieceVibration, BeginsWithoutAClickAndEndsInAir) {
    Cut cut(burr_of(6, 150.0, 0.02));
    EXPECT_LT(largest(cut.run(5)), 0.5 * mean_n);
    EXPECT_GT(largest(cut.run(200)), 0.9 * mean_n);
    cut.leave_bone();
    cut.run(200);
    EXPECT_EQ(largest(cut.run(200)), 0.0);
}

TEST(HandpieceVibration, IsSilentAtOnceWhereTheForceIsNotFeltOrTheSpindleStands) {
    for (bool Cut::*const off : {&Cut::is_felt, &Cut::spindle_on}) {
        Cut cut(burr_of(6, 150.0, 0.02));
        EXPECT_GT(largest(cut.run(500)), 0.9 * mean_n);
        cut.*off = false;
        EXPECT_EQ(largest(cut.run(10)), 0.0);
        cut.*off = true;
        EXPECT_EQ(glm::length(cut.tick()), 0.0) << "and begins anew";
        EXPECT_GT(largest(cut.run(200)), 0.9 * mean_n);
    }
}

TEST(HandpieceVibration, LeavesTheMeanForceItsRoomAndTheGuardNothingToDo) {
    Cut cut(burr_of(6, 300.0, 0.2), 3.3);
    cut.result().engagement.patches[0].cutting_n_s_per_mm = {-20.0 * resistance_n_s_per_mm, 0.0, 0.0};
    ForceGuard guard(3.3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 wanted_n = cut.tick();
        ASSERT_LT(glm::distance(guard.tick(wanted_n, Fault::none, tick_s), wanted_n), 1e-12);
    }
    EXPECT_GT(largest(cut.run(200)), 0.4);
    cut.more_mean_n = {0.0, 3.0, 0.0};
    for (const glm::dvec3& force_n : cut.run(200))
        ASSERT_LE(glm::length(cut.more_mean_n - glm::dvec3(mean_n, 0.0, 0.0) + force_n), 3.3);
    cut.more_mean_n = {0.0, 30.0, 0.0};
    EXPECT_EQ(largest(cut.run(200)), 0.0);
}

/// Whatever the hand does, the vibration has given it no more than half of what bone has taken.
void expect_paid(const std::function<glm::dvec3(const glm::dvec3& force_n)>& aside_mm,
                 double least_given_mj) {
    Cut cut(burr_of(6, 150.0, 0.02));
    glm::dvec3 force_n(0.0);
    for (int i = 0; i < 5000; ++i) {
        force_n = cut.tick(aside_mm(force_n));
        ASSERT_LE(cut.given_mj(), 0.5 * cut.taken_mj() + 1e-12) << "tick " << i;
        ASSERT_GE(cut.vibration().store_mj(), -1e-12) << "tick " << i;
    }
    EXPECT_GE(cut.given_mj(), least_given_mj) << "else this test tells nothing";
}

glm::dvec3 along(const glm::dvec3& force_n, double mm) {
    const double length = glm::length(force_n);
    return length > 0.0 ? force_n * (mm / length) : glm::dvec3(0.0);
}

TEST(HandpieceVibration, GivesAHandThatGoesAlongWithItNoMoreThanTheCutTook) {
    // In phase with the force, as fast as is reckoned with and slower: 9 mJ are taken in five seconds.
    expect_paid([](const glm::dvec3& force_n) { return along(force_n, 0.09); }, 1.0);
    expect_paid([](const glm::dvec3& force_n) { return along(force_n, 0.01); }, 1.0);
}

TEST(HandpieceVibration, GivesAHandThatMovesAtRandomNoMoreThanTheCutTook) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-0.05, 0.05);
    expect_paid([&](const glm::dvec3&) { return glm::dvec3(any(random), any(random), any(random)); }, -100.0);
    // Mostly along.
    expect_paid(
        [&](const glm::dvec3& force_n) {
            return along(force_n, 0.03) + glm::dvec3(any(random), any(random), any(random));
        },
        1.0);
}

TEST(HandpieceVibration, IsSilentForAHandThatTookTooMuchUntilTheCutHasPaid) {
    Cut cut(burr_of(6, 150.0, 0.02));
    cut.run(500);
    glm::dvec3 force_n = cut.tick();
    while (glm::length(force_n) < 0.2) force_n = cut.tick();
    cut.tick(along(force_n, 4.0));  // at four metres a second
    ASSERT_LT(cut.vibration().store_mj(), 0.0);
    int ticks = 0;
    for (force_n = cut.tick(); cut.vibration().store_mj() <= 0.0; force_n = cut.tick(), ++ticks)
        ASSERT_EQ(glm::length(force_n), 0.0);
    EXPECT_GT(ticks, 100);
    EXPECT_LE(cut.given_mj(), 0.5 * cut.taken_mj());
    EXPECT_GT(largest(cut.run(200)), 0.9 * mean_n);
}

TEST(HandpieceVibration, GivesNumbersWhateverItIsGiven) {
    const glm::dvec3 nothing(NAN, 0.0, INFINITY);
    Cut cut(burr_of(6, 150.0, 0.02));
    cut.run(500);
    for (int kind = 0; kind < 4; ++kind) {
        for (int i = 0; i < 20; ++i) {
            if (kind == 0) cut.more_mean_n = nothing;
            if (kind == 1) cut.result().engagement.patches[0].cutting_n_s_per_mm = nothing;
            if (kind == 2) cut.result().engagement.patches[0].normal = nothing;
            const glm::dvec3 force_n = cut.tick(kind == 3 && i == 0 ? nothing : glm::dvec3(0.0));
            ASSERT_TRUE(std::isfinite(glm::length(force_n))) << kind;
        }
        cut.more_mean_n = glm::dvec3(0.0);
        cut.face({0.0});
        if (kind == 3) return;
        EXPECT_GT(largest(cut.run(500)), 0.9 * mean_n) << "it does not stay with it, after " << kind;
    }
}

}  // namespace
}  // namespace osteomill::handpiece_vibration_test
