#include "analysis/report/plunge_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double plate_spacing_mm = 0.2;
constexpr double plunging_radius_mm = 1.0;
constexpr double plunging_frame_s = 1.0 / 30.0;

/// A plate from z = -1 to 1, 9.6 mm wide, in air.
bool is_plate(const glm::dvec3& place) {
    return std::abs(place.z) < 1.0;
}

template <typename Change>
void change_voxels(Bone& bone, Change&& change_voxel) {
    const BoneContent& content = bone.content();
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const glm::ivec3 first =
            brick_edge_voxels *
            brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            change_voxel(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset)),
                         bone.fractions(slot)[offset]);
    }
}

Bone bone_of(const std::function<bool(const glm::dvec3&)>& is_bone) {
    Bone bone =
        testing::labelled_cube(3, plate_spacing_mm, [](const glm::dvec3&) { return std::uint8_t{1}; });
    change_voxels(bone, [&](const glm::dvec3& at, std::uint8_t& left) { left = is_bone(at) ? 255 : 0; });
    return bone;
}

double distance_from_way(const glm::dvec3& at, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const double length2 = glm::dot(way, way);
    const double part = length2 > 0.0 ? std::clamp(glm::dot(at - from, way) / length2, 0.0, 1.0) : 0.0;
    return glm::length(at - from - part * way);
}

/// A ball that mills along `centre_at(time)`, its spindle upright, for `duration_s`.
std::vector<Breakthrough> breakthroughs_of(Bone bone, const std::function<glm::dvec3(double)>& centre_at,
                                           double duration_s, bool with_ticks = true,
                                           bool spindle_on = true) {
    PlungeWatch watch;
    for (int frame = 0; frame * plunging_frame_s <= duration_s; ++frame) {
        std::vector<ToolMoment> moments;
        const int ticks = with_ticks ? 33 : 1;
        for (int tick = 1; tick <= ticks; ++tick) {
            const double time_s = (frame - 1 + static_cast<double>(tick) / ticks) * plunging_frame_s;
            moments.push_back({time_s, centre_at(time_s), {0.0, 0.0, 1.0}, plunging_radius_mm, spindle_on});
        }
        bool cuts = false;
        const glm::dvec3 from = centre_at((frame - 1) * plunging_frame_s);
        change_voxels(bone, [&](const glm::dvec3& at, std::uint8_t& left) {
            if (!spindle_on || left == 0 ||
                distance_from_way(at, from, moments.back().burr_mm) > plunging_radius_mm)
                return;
            left = 0;
            cuts = true;
        });
        watch.update(bone, moments, cuts);
    }
    return watch.breakthroughs();
}

/// Straight down from 1 mm above the plate, as far as `deepest_mm` of the centre.
auto plunge(double speed_mm_per_s, double deepest_mm) {
    return [=](double time_s) {
        return glm::dvec3(0.05, -0.05, std::max(3.0 - speed_mm_per_s * std::max(0.0, time_s), deepest_mm));
    };
}

TEST(PlungeWatch, MeasuresHowFarTheTipIsBeyondTheFarWallAfter100Ms) {
    for (const bool with_ticks : {true, false})
        for (const double speed : {4.0, 15.0, 25.0}) {
            const auto found = breakthroughs_of(bone_of(is_plate), plunge(speed, -4.7), 1.8, with_ticks);
            ASSERT_EQ(found.size(), 1u) << speed << ' ' << with_ticks;
            EXPECT_NEAR(found[0].plunge_mm, 0.1 * speed, 0.5 * plate_spacing_mm)
                << speed << ' ' << with_ticks;
            // The tip starts 2 mm above z = 0, whose far wall is at -1.
            EXPECT_NEAR(found[0].time_s, 3.0 / speed, 0.5 * plate_spacing_mm / speed + 1e-3);
        }
}

TEST(PlungeWatch, KnowsTheHandThatStopsBehindTheWall) {
    const auto found = breakthroughs_of(bone_of(is_plate), plunge(20.0, -0.6), 1.0);  // tip at -1.6
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].plunge_mm, 0.6, 0.5 * plate_spacing_mm);
}

TEST(PlungeWatch, SeesNoneWhereNoWallEnds) {
    const auto all = [](const glm::dvec3&) { return true; };
    EXPECT_TRUE(breakthroughs_of(bone_of(all), plunge(15.0, -2.0), 0.6).empty()) << "in the depth of bone";
    EXPECT_TRUE(breakthroughs_of(bone_of(is_plate), plunge(15.0, 0.4), 0.6).empty()) << "stops before it";
    const auto cell = [](const glm::dvec3& at) { return at.z > 0.0 || at.z < -0.6; };
    EXPECT_TRUE(breakthroughs_of(bone_of(cell), plunge(15.0, 0.2), 0.6).empty()) << "a cell of 0.6 mm";
    EXPECT_TRUE(breakthroughs_of(bone_of(is_plate), plunge(15.0, -3.0), 0.6, true, false).empty())
        << "with the spindle off";
    const auto hole = [](const glm::dvec3& at) { return is_plate(at) && std::hypot(at.x, at.y) > 1.3; };
    EXPECT_TRUE(breakthroughs_of(bone_of(hole), plunge(15.0, -3.0), 0.6).empty()) << "through a hole";
    const auto sideways = [](double time_s) { return glm::dvec3(10.0 * time_s - 3.0, 0.0, 1.4); };
    EXPECT_TRUE(breakthroughs_of(bone_of(is_plate), sideways, 1.5).empty()) << "over the plate's edge";
}

TEST(PlungeWatch, CountsEachWallOfTwo) {
    const auto two = [](const glm::dvec3& at) {
        return (at.z > 0.4 && at.z < 1.0) || (at.z > -2.0 && at.z < -1.0);
    };
    const auto found = breakthroughs_of(bone_of(two), plunge(6.0, -4.5), 1.4);
    ASSERT_EQ(found.size(), 2u);
    const PlungeMetrics metrics = plunge_metrics(found);
    EXPECT_EQ(metrics.breakthroughs, 2u);
    EXPECT_NEAR(*metrics.mean_mm, 0.6, 0.5 * plate_spacing_mm);
    EXPECT_NEAR(*metrics.most_mm, 0.6, 0.5 * plate_spacing_mm);
    EXPECT_FALSE(plunge_metrics({}).mean_mm);
}

}  // namespace
}  // namespace osteomill
