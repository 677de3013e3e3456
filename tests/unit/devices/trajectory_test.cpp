#include "devices/simulated/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace osteomill::trajectory_test {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

std::vector<Waypoint> two_waypoints() {
    return {{1.0, {{0.0, 0.0, 5.0}, up}, true, 2},
            {3.0, {{4.0, 0.0, 5.0}, {1.0, 0.0, 0.0}}, true, std::nullopt}};
}

TEST(Trajectory, MovesOnStraightLinesBetweenWaypoints) {
    const Trajectory trajectory(two_waypoints());
    EXPECT_EQ(trajectory.at(1.5).target.position_mm, glm::dvec3(1.0, 0.0, 5.0));
    EXPECT_EQ(trajectory.at(2.0).target.position_mm, glm::dvec3(2.0, 0.0, 5.0));
}

TEST(Trajectory, TurnsTheSpindleAndKeepsItAUnitVector) {
    const glm::dvec3 axis = Trajectory(two_waypoints()).at(2.0).target.spindle_axis;
    EXPECT_NEAR(glm::length(axis), 1.0, 1e-12);
    EXPECT_NEAR(axis.x, std::sqrt(0.5), 1e-12);
}

TEST(Trajectory, RestsWithThePedalUpBeforeItBeginsAndAfterItEnds) {
    const Trajectory trajectory(two_waypoints());
    EXPECT_EQ(trajectory.at(0.0).target.position_mm, glm::dvec3(0.0, 0.0, 5.0));
    EXPECT_FALSE(trajectory.at(0.0).pedal);
    EXPECT_TRUE(trajectory.at(1.0).pedal);
    EXPECT_TRUE(trajectory.at(2.9).pedal);
    EXPECT_FALSE(trajectory.at(3.0).pedal);
    EXPECT_EQ(trajectory.at(99.0).target.position_mm, glm::dvec3(4.0, 0.0, 5.0));
    EXPECT_DOUBLE_EQ(trajectory.duration_s(), 3.0);
}

TEST(Trajectory, KeepsTheBurrUntilAnotherIsAskedFor) {
    const Trajectory trajectory(two_waypoints());
    EXPECT_EQ(trajectory.at(2.0).burr, 2u);
    EXPECT_EQ(trajectory.at(99.0).burr, 2u);
}

TEST(Trajectory, NeverEndsWithASingleWaypoint) {
    const Trajectory trajectory({{0.0, {{1.0, 2.0, 3.0}, up}, true, std::nullopt}});
    EXPECT_TRUE(std::isinf(trajectory.duration_s()));
    EXPECT_TRUE(trajectory.at(1e9).pedal);
}

TEST(Trajectory, RefusesWaypointsThatMakeNoMotion) {
    EXPECT_THROW(Trajectory({}), std::invalid_argument);
    auto backwards = two_waypoints();
    backwards[1].time_s = 1.0;
    EXPECT_THROW(Trajectory(std::move(backwards)), std::invalid_argument);
    auto nowhere = two_waypoints();
    nowhere[0].pose.position_mm.y = NAN;
    EXPECT_THROW(Trajectory(std::move(nowhere)), std::invalid_argument);
    auto long_axis = two_waypoints();
    long_axis[0].pose.spindle_axis *= 2.0;
    EXPECT_THROW(Trajectory(std::move(long_axis)), std::invalid_argument);
}

}  // namespace
}  // namespace osteomill::trajectory_test
