#include "haptic_server/milling/tip_disc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "haptic_server/milling/axis_means.h"

namespace osteomill {
namespace {

constexpr double disc = tip_disc_voxels;

glm::dvec2 pointing(double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle)};
}

/// By squares of a hundredth of a voxel, from the face as a plane in space.
TipDiscSums by_squares(double radius, const glm::dvec3& direction, const FaceAtTip& face) {
    constexpr double cell = 0.01;
    const double theta = std::atan2(1.0, face.cot_theta);
    const glm::dvec3 normal(std::sin(theta) * face.outward, std::cos(theta));
    const auto on_burr = [&](const glm::dvec2& place) {
        return glm::dvec3(place, -std::sqrt(radius * radius - glm::dot(place, place)));
    };
    const double offset = glm::dot(normal, on_burr(face.distance_voxels * face.outward));
    TipDiscSums sums;
    for (double y = -disc + 0.5 * cell; y < disc; y += cell)
        for (double x = -disc + 0.5 * cell; x < disc; x += cell) {
            const double r_squared = x * x + y * y;
            if (r_squared >= disc * disc) continue;
            const glm::dvec3 point = on_burr({x, y});
            const double cos_kappa = -point.z / radius;
            const double chip = glm::dot(point, direction) / radius / cos_kappa * cell * cell;
            if (chip <= 0.0 || glm::dot(normal, point) >= offset) continue;
            const double counted = (1.0 - r_squared / (disc * disc)) * chip;
            sums.volume += counted;
            sums.moment += counted * glm::dvec2(x, y);
            const double r = std::sqrt(r_squared);
            const AxisMeans<double> mean = axis_means(r_squared, 1.0 / r);
            sums.missing += chip * glm::dvec3((1.0 / r_squared - mean.swirl) * glm::dvec2(x, y),
                                              (1.0 / r - mean.inverse) * cos_kappa);
        }
    return sums;
}

struct Cut {
    double radius;
    glm::dvec3 direction;
    FaceAtTip face;
};

/// Burrs of 10 to 50 voxels, steep faces and shallow ones; the chip of some ends on the disc as well.
std::vector<Cut> cuts() {
    std::vector<Cut> cuts;
    double turn = 10.0;
    for (const double radius : {5.0, 25.0})
        for (const glm::dvec3& way :
             {glm::dvec3(0, 0, -1), glm::dvec3(0.5, 0.3, -0.8), glm::dvec3(0.9, 0.3, -0.1)})
            for (const double distance : {-1.6, -0.4, 0.0, 0.7, 1.9})
                cuts.push_back({radius,
                                glm::normalize(way),
                                {pointing(turn += 77.0), distance, std::fmod(0.013 * turn, 2.0) - 0.5}});
    return cuts;
}

TEST(TipDisc, AgreesWithSmallSquares) {
    TipDisc tip(InstructionSet::plain);
    for (const Cut& c : cuts()) {
        SCOPED_TRACE(::testing::Message()
                     << "R " << c.radius << ", way along the axis " << c.direction.z << ", d "
                     << c.face.distance_voxels << ", cot theta " << c.face.cot_theta);
        tip.begin(c.radius, c.direction);
        const TipDiscSums sums = tip.cut_by(c.face);
        const TipDiscSums exact = by_squares(c.radius, c.direction, c.face);
        const double whole = tip.whole().volume;
        EXPECT_NEAR(sums.volume, exact.volume, 0.01 * whole);
        EXPECT_LT(glm::length(sums.moment - exact.moment), 0.01 * disc * whole);
        // Of the kink that is to be found, 0.82 of the chip at the tip.
        const double chip = std::max(-c.direction.z, 0.3);
        EXPECT_LT(glm::length(sums.missing - exact.missing), 0.06 * chip);
    }
}

TEST(TipDisc, KnowsHowItsSumsChangeWithTheFace) {
    // What has width changes in steps as the face passes cells: over half a voxel that evens out.
    TipDisc tip(InstructionSet::plain);
    for (const Cut& c : cuts()) {
        tip.begin(c.radius, c.direction);
        constexpr int steps = 25;
        constexpr double distance = 0.02;
        const double angle = 0.01;
        glm::dvec3 by_distance(0.0);
        glm::dvec3 by_turn(0.0);
        FaceAtTip moved = c.face;
        FaceAtTip turned = c.face;
        const double start = std::atan2(c.face.outward.y, c.face.outward.x);
        const auto all = [](const TipDiscSums& s) { return glm::dvec3(s.volume, s.moment); };
        for (int i = 0; i < steps; ++i) {
            moved.distance_voxels = c.face.distance_voxels + (i + 0.5) * distance;
            turned.outward = {std::cos(start + (i + 0.5) * angle), std::sin(start + (i + 0.5) * angle)};
            by_distance += distance * tip.cut_by(moved).per_distance;
            by_turn += angle * tip.cut_by(turned).per_turn;
        }
        moved.distance_voxels = c.face.distance_voxels + steps * distance;
        turned.outward = {std::cos(start + steps * angle), std::sin(start + steps * angle)};
        const glm::dvec3 begin = all(tip.cut_by(c.face));
        const double scale = glm::length(all(tip.whole()));
        EXPECT_LT(glm::length(all(tip.cut_by(moved)) - begin - by_distance), 0.02 * scale);
        EXPECT_LT(glm::length(all(tip.cut_by(turned)) - begin - by_turn), 0.02 * scale);
    }
}

TEST(TipDisc, MissesNothingOfAChipThatGoesOn) {
    TipDisc tip(best_instruction_set());
    tip.begin(1e6, {0.0, 0.0, -1.0});
    const TipDiscSums whole = tip.whole();
    EXPECT_NEAR(whole.volume, 0.5 * std::numbers::pi * disc * disc, 1e-3);
    EXPECT_LT(glm::length(whole.moment), 1e-4);
    EXPECT_LT(glm::length(glm::dvec2(whole.missing)), 1e-4);
    EXPECT_NEAR(whole.missing.z, 0.0, 0.02);
    // A face far off leaves it whole.
    EXPECT_NEAR(tip.cut_by({{1.0, 0.0}, 3.6, 0.0}).volume, whole.volume, 1e-3);
    EXPECT_NEAR(tip.cut_by({{1.0, 0.0}, -3.6, 0.0}).volume, 0.0, 1e-3);
}

TEST(TipDisc, GivesTheSameWithEveryInstructionSet) {
    TipDisc plain(InstructionSet::plain);
    TipDisc best(best_instruction_set());
    for (const Cut& c : cuts()) {
        plain.begin(c.radius, c.direction);
        best.begin(c.radius, c.direction);
        const TipDiscSums a = plain.cut_by(c.face);
        const TipDiscSums b = best.cut_by(c.face);
        EXPECT_EQ(a.volume, b.volume);
        EXPECT_EQ(a.moment, b.moment);
        EXPECT_EQ(a.missing, b.missing);
        EXPECT_EQ(a.per_distance, b.per_distance);
        EXPECT_EQ(a.per_turn, b.per_turn);
    }
}

}  // namespace
}  // namespace osteomill
