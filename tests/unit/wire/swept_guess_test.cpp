#include "common/wire/swept_guess.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/support/smoothed_ramp.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

constexpr double radius = 10.0;

/// What a ball at `centre` leaves of a voxel, by milling's law (cover.h) in plain double.
int left_by_law(const glm::dvec3& voxel, const glm::dvec3& centre, double smoothing) {
    const glm::dvec3 off = voxel - centre;
    const double beyond = std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z) - radius;
    const double left = testing::left_by_ramp(beyond, smoothing);
    return static_cast<int>(255.0 * left + 0.5);
}

GuessedSweep sweep_of(const glm::dvec3& from, const glm::dvec3& to, double smoothing = 0.0) {
    return guessed_sweep(from, to, radius, smoothing).value();
}

std::string error_of(const v1::GuessedSweep& message) {
    const auto sweep = guessed_sweep_from(message);
    const auto* error = std::get_if<WireError>(&sweep);
    return error != nullptr ? error->line : "";
}

TEST(SweptGuess, IsTheLawOfMillingToAStepOfRounding) {
    // Down into the brick from above: what is ahead of the burr is nearest to the way's end.
    const glm::dvec3 from(7.3, 8.1, 27.2), to(7.3, 8.1, 20.7);
    int partial_of_the_sharpest = 0;
    for (const double smoothing : {0.0, 1.0 / 65536.0, 0.3, std::sqrt(0.5), 1.0}) {
        const BrickGuess guess = guess_brick(sweep_of(from, to, smoothing), {0, 0, 0});
        int partial = 0;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::dvec3 voxel(voxel_in_brick(offset));
            const int left = left_by_law(voxel, to, smoothing);
            const int before = left_by_law(voxel, from, smoothing);
            if (!guess.changed[offset]) {
                EXPECT_GE(left, before - 1) << offset;
                EXPECT_EQ(guess.left[offset], 0);
                continue;
            }
            EXPECT_NEAR(guess.left[offset], left, 1) << offset << " smoothed over " << smoothing;
            EXPECT_LT(left, before + 1);
            partial += left > 0 ? 1 : 0;
        }
        EXPECT_GT(guess.changed.count(), 500U);
        EXPECT_GT(partial, 100);
        if (smoothing == 0.0) partial_of_the_sharpest = partial;
        if (smoothing > 0.5) {
            EXPECT_GT(partial, partial_of_the_sharpest) << "the rim is wider";
        }
    }
}

TEST(SweptGuess, IsTheSameToTheBitOnAnyMachine) {
    // Worked out in whole numbers: a ball that came down on voxels below it, at -45536, 20000 and 85536 of
    // 1/65536 voxel from its surface. 20000 - 10403^2 / 92682 = 18833, 45536 - 35939^2 / 92682 = 31601.
    constexpr std::int64_t voxel = GuessedSweep::units_per_voxel;
    const BrickGuess guess = guess_brick({.from = {0, 0, 30 * voxel},
                                          .to = {0, 0, 10 * voxel + 20000},
                                          .radius = 3 * voxel,
                                          .smoothing = 46341},
                                         {0, 0, 0});
    const auto below = [](int z) { return offset_in_brick({0, 0, z}); };
    EXPECT_FALSE(guess.changed[below(6)]);
    EXPECT_TRUE(guess.changed[below(7)]);
    EXPECT_EQ(guess.left[below(7)], 201);
    EXPECT_TRUE(guess.changed[below(8)]);
    EXPECT_EQ(guess.left[below(8)], 5);
}

TEST(SweptGuess, IsNothingForABurrThatRestsOrIsElsewhere) {
    const glm::dvec3 here(8.0, 8.0, 20.0);
    EXPECT_TRUE(guess_brick(sweep_of(here, here), {0, 0, 0}).changed.none());
    EXPECT_TRUE(guess_brick(sweep_of(here, here, 1.0), {0, 0, 0}).changed.none());
    EXPECT_TRUE(guess_brick(sweep_of(here, {8.0, 8.0, 22.0}), {5, 0, 0}).changed.none());
}

TEST(SweptGuess, IsTheSameWhereverInTheGridItIs) {
    const glm::dvec3 from(7.25, 8.5, 26.0), to(8.75, 8.25, 21.5);
    const glm::ivec3 brick(4000, 3, 4095);
    const glm::dvec3 shift = 16.0 * glm::dvec3(brick);
    const BrickGuess near = guess_brick(sweep_of(from, to, 0.5), {0, 0, 0});
    const BrickGuess far = guess_brick(sweep_of(from + shift, to + shift, 0.5), brick);
    EXPECT_EQ(near.changed, far.changed);
    EXPECT_EQ(near.left, far.left);
}

TEST(SweptGuess, IsMadeOnlyOfWhatItsArithmeticCanHold) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(guessed_sweep({nan, 0, 0}, {0, 0, 0}, radius));
    EXPECT_FALSE(guessed_sweep({0, 0, 0}, {0, 0, 1e300}, radius));
    EXPECT_FALSE(guessed_sweep({0, 0, 0}, {0, 65, 0}, radius));
    EXPECT_FALSE(guessed_sweep({0, 0, 0}, {0, 1, 0}, 257.0));
    EXPECT_FALSE(guessed_sweep({0, 0, 0}, {0, 1, 0}, 0.0));
    for (const double smoothing : {nan, -0.1, 1.1, 1e300})
        EXPECT_FALSE(guessed_sweep({0, 0, 0}, {0, 1, 0}, radius, smoothing)) << smoothing;
    EXPECT_TRUE(guessed_sweep({0, 0, 0}, {0, 64, 0}, 256.0, 1.0));
}

TEST(SweptGuess, IsReadFromAMessageAsItWasWrittenOrRefused) {
    const GuessedSweep sweep = *guessed_sweep({-1.5, 2.25, 70000.0}, {-1.0, 2.5, 69999.0}, 12.125, 0.75);
    EXPECT_EQ(std::get<GuessedSweep>(guessed_sweep_from(to_message(sweep))), sweep);
    v1::GuessedSweep message = to_message(sweep);
    message.add_to(0);
    EXPECT_THAT(error_of(message), HasSubstr("coordinates"));
    message = to_message(sweep);
    message.set_radius(std::numeric_limits<std::uint64_t>::max());
    EXPECT_THAT(error_of(message), HasSubstr("too thick"));
    message = to_message(sweep);
    message.set_from(0, std::numeric_limits<std::int64_t>::min());
    EXPECT_THAT(error_of(message), HasSubstr("beyond any grid"));
    message.set_from(0, 0);
    EXPECT_EQ(error_of(message), "");
    message.set_to(0, 65 * GuessedSweep::units_per_voxel);
    EXPECT_THAT(error_of(message), HasSubstr("too long"));
    message = to_message(sweep);
    message.set_smoothing(GuessedSweep::units_per_voxel + 1);
    EXPECT_EQ(error_of(message), "a guessed sweep is smoothed over more than a voxel");
    message.clear_smoothing();
    EXPECT_EQ(std::get<GuessedSweep>(guessed_sweep_from(message)).smoothing, 0) << "as before protocol 1.4";
}

}  // namespace
}  // namespace osteomill
