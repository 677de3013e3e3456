#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "devices/simulated/trajectory.h"

namespace osteomill::built_in_trajectories_test {
namespace {

const ToolPose start_pose{{0.0, 0.0, 6.0}, {0.0, 0.0, 1.0}};
const Burr small_burr{.name = "1.5 mm", .diameter_mm = 1.5};
const Burr large_burr{.name = "5 mm", .diameter_mm = 5.0};

TrajectorySpec cavity_spec() {
    return {.source = BuiltInTrajectory::cavity,
            .start_mm = {1.0, 2.0, 3.0},
            .speed_mm_per_s = 4.0,
            .depth_mm = 2.8,
            .width_mm = 4.5};
}

TrajectorySpec polishing_spec(double slide_mm) {
    return {.source = BuiltInTrajectory::polishing,
            .start_mm = {-20.0, 0.0, 0.0},
            .travel_direction = {1.0, 0.0, 0.3},
            .speed_mm_per_s = 6.0,
            .depth_mm = 3.5,
            .width_mm = slide_mm};
}

double fastest_mm_per_s(const std::vector<Waypoint>& waypoints) {
    double fastest = 0.0;
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
        fastest = std::max(fastest,
                           glm::distance(waypoints[i].pose.position_mm, waypoints[i - 1].pose.position_mm) /
                               (waypoints[i].time_s - waypoints[i - 1].time_s));
    }
    return fastest;
}

/// Distance of a point from the polyline between waypoints, near enough: waypoints are 0.1 mm apart.
double nearest_mm(const std::vector<Waypoint>& waypoints, const glm::dvec3& point) {
    double nearest = 1e9;
    for (const Waypoint& w : waypoints) nearest = std::min(nearest, glm::distance(w.pose.position_mm, point));
    return nearest;
}

TEST(HoldTrajectory, StaysAtTheStartPoseWithThePedalUp) {
    const Trajectory hold(hold_waypoints(start_pose));
    EXPECT_EQ(hold.at(5.0).target, start_pose);
    EXPECT_FALSE(hold.at(5.0).pedal);
}

TEST(CavityTrajectory, ClearsTheWholeHoleAndNothingBeyondItsWall) {
    const auto waypoints = cavity_waypoints(cavity_spec(), start_pose, small_burr);
    const glm::dvec3 mouth = cavity_spec().start_mm;
    for (const Waypoint& w : waypoints) {
        if (!w.pedal) continue;
        const glm::dvec3 from_mouth = w.pose.position_mm - mouth;
        EXPECT_LE(std::hypot(from_mouth.x, from_mouth.y), 1.5 + 1e-9);
        EXPECT_GE(from_mouth.z, 0.75 - 2.8 - 1e-9);
    }
    // Every point of the hole, up to the fillet that a ball leaves at the bottom, comes under the burr.
    for (double z = -2.0; z < -0.05; z += 0.13) {
        for (double r = 0.0; r <= 2.15; r += 0.13) {
            for (double angle = 0.0; angle < 6.3; angle += 0.5) {
                const glm::dvec3 point = mouth + glm::dvec3(r * std::cos(angle), r * std::sin(angle), z);
                ASSERT_LE(nearest_mm(waypoints, point), 0.75 + 0.05) << "r " << r << " z " << z;
            }
        }
    }
}

TEST(CavityTrajectory, StartsAndStopsTheSpindleClearOfTheBone) {
    const auto waypoints = cavity_waypoints(cavity_spec(), start_pose, small_burr);
    EXPECT_EQ(waypoints.front().pose, start_pose);
    EXPECT_FALSE(waypoints.front().pedal);
    EXPECT_FALSE(waypoints.back().pedal);
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
        if (waypoints[i].pedal == waypoints[i - 1].pedal) continue;
        EXPECT_GE(waypoints[i].pose.position_mm.z - small_burr.radius_mm(), 3.0 + clearance_mm - 1e-9);
    }
}

TEST(CavityTrajectory, IsNoFasterThanAskedWhileItCuts) {
    auto waypoints = cavity_waypoints(cavity_spec(), start_pose, small_burr);
    std::erase_if(waypoints, [](const Waypoint& w) { return !w.pedal; });
    EXPECT_LE(fastest_mm_per_s(waypoints), 4.0 * (1.0 + 1e-9));
}

TEST(CavityTrajectory, PlungesStraightWhereTheHoleIsAsWideAsTheBurr) {
    TrajectorySpec spec = cavity_spec();
    spec.width_mm = small_burr.diameter_mm;
    for (const Waypoint& w : cavity_waypoints(spec, start_pose, small_burr)) {
        if (!w.pedal) continue;
        EXPECT_NEAR(w.pose.position_mm.x, 1.0, 1e-12);
    }
}

TEST(CavityTrajectory, RefusesABurrWiderThanTheHole) {
    EXPECT_THROW(cavity_waypoints(cavity_spec(), start_pose, large_burr), std::invalid_argument);
}

TEST(CavityTrajectory, FollowsATiltedSpindle) {
    const ToolPose tilted{{0.0, 0.0, 6.0}, glm::normalize(glm::dvec3(0.3, -0.2, 1.0))};
    double deepest_mm = 0.0;
    for (const Waypoint& w : cavity_waypoints(cavity_spec(), tilted, small_burr)) {
        const glm::dvec3 lowest = w.pose.position_mm - small_burr.radius_mm() * tilted.spindle_axis;
        deepest_mm = std::max(deepest_mm, -glm::dot(lowest - cavity_spec().start_mm, tilted.spindle_axis));
    }
    EXPECT_NEAR(deepest_mm, 2.8, 1e-9);
}

TEST(PolishingTrajectory, SlidesFortyMillimetresInAboutSevenSecondsToItsDepth) {
    const auto waypoints = polishing_waypoints(polishing_spec(40.0), start_pose, large_burr);
    double began_s = 0.0;
    double ended_s = 0.0;
    glm::dvec3 end(0.0);
    for (const Waypoint& w : waypoints) {
        const double height_mm = w.pose.position_mm.z - large_burr.radius_mm();
        if (w.pedal && height_mm <= 0.0) {
            if (began_s == 0.0) began_s = w.time_s;
            if (height_mm < end.z) {
                end = {w.pose.position_mm.x, w.pose.position_mm.y, height_mm};
                ended_s = w.time_s;
            }
        }
    }
    EXPECT_NEAR(end.x, 20.0, 1e-9);
    EXPECT_NEAR(end.z, -3.5, 1e-9);
    EXPECT_NEAR(ended_s - began_s, 7.0, 0.7);
}

TEST(PolishingTrajectory, GoesToAndFroOverAShorterSlide) {
    const auto waypoints = polishing_waypoints(polishing_spec(10.0), start_pose, large_burr);
    int turns = 0;
    double direction = 1.0;
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
        const bool is_in_bone = waypoints[i - 1].pose.position_mm.z <= large_burr.radius_mm();
        if (!is_in_bone) continue;
        const double dx = waypoints[i].pose.position_mm.x - waypoints[i - 1].pose.position_mm.x;
        EXPECT_LE(waypoints[i].pose.position_mm.x, -10.0 + 1e-9);
        if (dx * direction < -1e-9) {
            ++turns;
            direction = -direction;
        }
    }
    EXPECT_EQ(turns, 3) << "40 mm of travel in strokes of 10";
}

TEST(PolishingTrajectory, WaversInTiltByAFewDegrees) {
    double largest_rad = 0.0;
    for (const Waypoint& w : polishing_waypoints(polishing_spec(40.0), start_pose, large_burr)) {
        EXPECT_NEAR(glm::length(w.pose.spindle_axis), 1.0, 1e-12);
        largest_rad = std::max(largest_rad, std::acos(std::min(1.0, w.pose.spindle_axis.z)));
    }
    EXPECT_GT(largest_rad, 0.02);
    EXPECT_LT(largest_rad, 0.1);
}

TEST(PolishingTrajectory, RefusesToSlideAlongTheSpindle) {
    TrajectorySpec spec = polishing_spec(40.0);
    spec.travel_direction = {0.0, 0.0, 2.0};
    EXPECT_THROW(polishing_waypoints(spec, start_pose, large_burr), std::invalid_argument);
}

TEST(BuiltInTrajectories, RefuseSizesThatAreNotPositive) {
    TrajectorySpec spec = cavity_spec();
    spec.speed_mm_per_s = 0.0;
    EXPECT_THROW(cavity_waypoints(spec, start_pose, small_burr), std::invalid_argument);
    spec = cavity_spec();
    spec.depth_mm = -1.0;
    EXPECT_THROW(polishing_waypoints(spec, start_pose, small_burr), std::invalid_argument);
    spec = cavity_spec();
    spec.width_mm = NAN;
    EXPECT_THROW(cavity_waypoints(spec, start_pose, small_burr), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::built_in_trajectories_test
