#include "haptic_server/milling/onsets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "common/bone/bone.h"

namespace osteomill {
namespace {

constexpr double radius = 25.0;
const glm::dvec3 voxel(30.0, 40.0, 8.0);
constexpr float left = 100.0f;
/// Of the burr's path, from the voxel.
constexpr double across = 24.0;

AwaitingVoxels one_voxel(const glm::dvec3& from, const glm::dvec3& along) {
    AwaitingVoxels awaiting;
    awaiting.from = from;
    awaiting.along = along;
    awaiting.count = 1;
    awaiting.x[0] = static_cast<float>(voxel.x);
    awaiting.y[0] = static_cast<float>(voxel.y);
    awaiting.z[0] = static_cast<float>(voxel.z);
    awaiting.left[0] = left;
    awaiting.slot[0] = awaiting.offset[0] = 0;
    awaiting.pad();
    return awaiting;
}

/// Fraction that the voxel is given by a step from `from`.
double given(const glm::dvec3& from, const glm::dvec3& along, double removed_codes = 1e6) {
    const BoneContent homogeneous;
    Onsets onsets(radius, VoxelEdges::soft, homogeneous, best_instruction_set());
    onsets.removed(removed_codes);
    onsets.take(one_voxel(from, along));
    double sum = 0.0;
    for (const float weight : onsets.weights()) sum += static_cast<double>(weight);
    return sum;
}

/// A place from which the burr, going along x, meets the voxel after `way`: its centre is then as far off as
/// the ramp leaves, rounded, more than `left`.
glm::dvec3 place_before(double way, VoxelEdges edges = VoxelEdges::soft) {
    double near = 0.0;
    double far = 10.0;
    for (int i = 0; i < 60; ++i) {
        const double ahead = 0.5 * (near + far);
        const glm::dvec3 at = voxel - glm::dvec3(ahead, across, 0.0);
        const SweepSeenFrom ball({at, at, radius}, glm::dvec3(0.0), edges);
        const auto x = static_cast<float>(voxel.x);
        const auto y = static_cast<float>(voxel.y);
        const auto z = static_cast<float>(voxel.z);
        const int most_left = edges == VoxelEdges::soft ? fraction_left<VoxelEdges::soft>(ball, x, y, z)
                                                        : fraction_left<VoxelEdges::partial>(ball, x, y, z);
        (most_left > static_cast<int>(left) ? far : near) = ahead;
    }
    return voxel - glm::dvec3(near + way, across, 0.0);
}

TEST(Onsets, GiveNothingInSumOnTheWholeWay) {
    // The voxel is met between two steps; the lattice's planes are a voxel apart.
    for (const double length : {0.05, 0.2, 0.5}) {
        double sum = 0.0;
        double most = 0.0;
        for (double still = 0.3 * length; still < 2.0; still += length) {
            const double step = given(place_before(still + length), {length, 0.0, 0.0});
            sum += step;
            most = std::max(most, std::abs(step));
        }
        EXPECT_GT(most, 0.01 * length) << length;
        EXPECT_NEAR(sum, 0.0, 1e-4) << length;
    }
    // Steps that do not fit into the period: on the mean over where they fall.
    constexpr double length = 0.37;
    double mean = 0.0;
    constexpr int places = 200;
    for (int i = 0; i < places; ++i)
        for (double still = (i + 0.5) / places * length; still < 2.0; still += length)
            mean += given(place_before(still + length), {length, 0.0, 0.0}) / places;
    EXPECT_NEAR(mean, 0.0, 1e-4);
}

TEST(Onsets, TakeFirstAndGiveThen) {
    constexpr double length = 0.1;
    const glm::dvec3 along(length, 0.0, 0.0);
    // In its middle the ramp falls by 1 a voxel.
    const double met = radius + (static_cast<double>(left) + 0.5) / 255.0 - 0.5;
    const double rate = std::sqrt(met * met - across * across) / met;
    EXPECT_NEAR(given(place_before(1.0), along), -0.45 * rate * length, 0.002 * length);
    EXPECT_NEAR(given(place_before(0.55), along), 0.0, 0.002 * length);
    EXPECT_NEAR(given(place_before(0.15), along), 0.4 * rate * length, 0.002 * length);
    EXPECT_EQ(given(place_before(1.2), along), 0.0) << "another voxel comes before it";
}

TEST(Onsets, LieWhereTheBurrWillMeetThem) {
    for (const VoxelEdges edges : {VoxelEdges::soft, VoxelEdges::partial}) {
        const BoneContent homogeneous;
        Onsets onsets(radius, edges, homogeneous, best_instruction_set());
        onsets.removed(1e6);
        const glm::dvec3 from = place_before(0.5, edges);
        const glm::dvec3 along(0.06, 0.0, 0.0);
        onsets.take(one_voxel(from, along));
        ASSERT_GT(onsets.voxels().count, 0u);
        const glm::dvec3 place(static_cast<double>(onsets.voxels().x[0]),
                               static_cast<double>(onsets.voxels().y[0]),
                               static_cast<double>(onsets.voxels().z[0]));
        const glm::dvec3 from_middle = place - (from + 0.5 * along);
        const glm::dvec3 when_met = voxel - place_before(0.0, edges);
        EXPECT_LT(glm::distance(from_middle, when_met), 1e-3);
    }
}

TEST(Onsets, AreNoneAtRestInAirAndWithWholeVoxels) {
    const glm::dvec3 from = place_before(0.2);
    const glm::dvec3 along(0.1, 0.0, 0.0);
    ASSERT_GT(given(from, along), 0.0);
    EXPECT_EQ(given(from, glm::dvec3(0.0)), 0.0);
    EXPECT_EQ(given(from, -along), 0.0) << "on the way back";
    EXPECT_EQ(given(from, along, 0.0), 0.0) << "nothing was removed";
    EXPECT_NEAR(given(from, along, 1.0), 1.0 / 255.0, 1e-6) << "no more than was removed";
    const BoneContent homogeneous;
    Onsets whole(radius, VoxelEdges::whole, homogeneous, best_instruction_set());
    whole.removed(1e6);
    whole.take(one_voxel(from, along));
    EXPECT_EQ(whole.voxels().count, 0u);
}

TEST(Onsets, AreTheSameWithEveryInstructionSet) {
    if (best_instruction_set() == InstructionSet::plain) GTEST_SKIP() << "this processor has no other set";
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(-1.0, 1.0);
    AwaitingVoxels awaiting;
    awaiting.from = {30.2, 30.4, 30.3};
    awaiting.along = {0.3, -0.2, 0.1};
    for (; awaiting.count < AwaitingVoxels::capacity; ++awaiting.count) {
        const glm::dvec3 at =
            glm::round(awaiting.from +
                       (radius + 0.3) * glm::normalize(glm::dvec3(part(random), part(random), part(random))));
        awaiting.x[awaiting.count] = static_cast<float>(at.x);
        awaiting.y[awaiting.count] = static_cast<float>(at.y);
        awaiting.z[awaiting.count] = static_cast<float>(at.z);
        awaiting.left[awaiting.count] = static_cast<float>(1 + random() % 254);
        awaiting.slot[awaiting.count] = awaiting.offset[awaiting.count] = 0;
    }
    const BoneContent homogeneous;
    Onsets plain(radius, VoxelEdges::soft, homogeneous, InstructionSet::plain);
    Onsets best(radius, VoxelEdges::soft, homogeneous, best_instruction_set());
    for (Onsets* onsets : {&plain, &best}) {
        onsets->removed(1e6);
        onsets->take(awaiting);
    }
    const auto not_zero = [](float weight) { return weight != 0.0f; };
    EXPECT_GT(std::count_if(plain.weights().begin(), plain.weights().end(), not_zero), 20);
    EXPECT_TRUE(std::equal(plain.weights().begin(), plain.weights().end(), best.weights().begin(),
                           best.weights().end()));
    for (std::size_t i = 0; i < plain.voxels().count; ++i)
        EXPECT_EQ(plain.voxels().x[i], best.voxels().x[i]) << i;
}

}  // namespace
}  // namespace osteomill
