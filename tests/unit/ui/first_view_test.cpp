#include "render_client/dataset/first_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "studies/render/made_bone.h"
#include "tests/support/block.h"

namespace osteomill {
namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);
constexpr glm::ivec2 picture_px(1280, 800);

/// 60 x 60 x 20 mm, its top at z = 0.
const Bone& slab() {
    static const Bone bone = testing::make_block({-30.0, -30.0, -20.0}, {30.0, 30.0, 0.0}, 0.5);
    return bone;
}
const BallInView all{{0.0, 0.0, -10.0}, 0.5 * std::sqrt(60.0 * 60.0 + 60.0 * 60.0 + 20.0 * 20.0)};

void expect_in_picture(const Camera& camera, const glm::dvec3& place_mm) {
    const glm::dvec2 pixel = pixel_of(camera, place_mm, picture_px);
    EXPECT_GT(pixel.x, 0.1 * picture_px.x);
    EXPECT_LT(pixel.x, 0.9 * picture_px.x);
    EXPECT_GT(pixel.y, 0.1 * picture_px.y);
    EXPECT_LT(pixel.y, 0.9 * picture_px.y);
}

TEST(FirstView, IsOfAllTheBoneWithoutATool) {
    EXPECT_EQ(first_view(slab(), all, std::nullopt, 0.0, std::nullopt),
              camera_on(all.centre_mm, all.radius_mm));
}

TEST(FirstView, HoldsToolAndTarget) {
    const BallInView target{{-10.0, 5.0, -2.0}, 2.0};
    const ToolPose tool{{5.0, 5.0, 4.0}, up};
    const Camera camera = first_view(slab(), all, tool, 1.0, target);
    expect_in_picture(camera, tool.position_mm);
    expect_in_picture(camera, target.centre_mm);
    EXPECT_LT(camera.distance_mm, camera_on(all.centre_mm, all.radius_mm).distance_mm);
    // Near to each other they are shown larger, but not on a wall.
    const Camera near = first_view(slab(), all, ToolPose{{-10.0, 5.0, 2.0}, up}, 1.0, target);
    EXPECT_LT(near.distance_mm, camera.distance_mm);
    EXPECT_GE(near.distance_mm, 0.25 * camera_on(all.centre_mm, all.radius_mm).distance_mm - 1e-9);
}

TEST(FirstView, IsFromTheSideThatTheToolIsOn) {
    for (const glm::dvec3& axis : {up, -up, glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)}) {
        const glm::dvec3 half_mm(30.0, 30.0, 10.0);
        const ToolPose tool{all.centre_mm + axis * (half_mm + 3.0), axis};
        const Camera camera = first_view(slab(), all, tool, 1.0, std::nullopt);
        EXPECT_GT(glm::dot(-camera.forward(), axis), 0.55);
        expect_in_picture(camera, tool.position_mm);
    }
    // From above the usual view will do.
    EXPECT_NEAR(first_view(slab(), all, ToolPose{{0.0, 0.0, 4.0}, up}, 1.0, std::nullopt).azimuth_rad,
                camera_on(all.centre_mm, all.radius_mm).azimuth_rad, 1e-12);
}

TEST(FirstView, LooksDownAHoleInWhichTheBurrIs) {
    const Bone bone =
        testing::make_block({-30.0, -30.0, -20.0}, {30.0, 30.0, 0.0}, 0.5, [](const glm::dvec3& place) {
            return place.z > -12.0 && std::hypot(place.x, place.y) < 2.0 ? -1.0 : 1.0;
        });
    const Camera camera = first_view(bone, all, ToolPose{{0.0, 0.0, -10.0}, up}, 1.0, std::nullopt);
    EXPECT_GT(glm::dot(-camera.forward(), up), 0.99);
}

TEST(FirstView, FindsThePlansTissueInTheBone) {
    SessionInfo session;
    EXPECT_FALSE(target_in_view(slab(), session));
    session.plan = Plan{.region = TissueRegion{"lesion"}};
    EXPECT_FALSE(target_in_view(slab(), session)) << "it is nowhere";
    session.plan->region = CylinderRegion{{0.0, 0.0, 0.0}, {0.0, 0.0, -8.0}, 3.0};
    const auto target = target_in_view(slab(), session);
    ASSERT_TRUE(target);
    EXPECT_EQ(target->centre_mm, glm::dvec3(0.0, 0.0, -4.0));
    EXPECT_DOUBLE_EQ(target->radius_mm, 5.0);
    // A lesion of 2 x 2 x 2 mm in a labelled bone, between its outermost voxels' centres.
    const Bone labelled = made_bone(
        {.size_voxels = {64, 64, 64}, .spacing_mm = 0.25}, [](const glm::dvec3&) { return 1.0; },
        [](const glm::dvec3& place) {
            return static_cast<std::uint8_t>(
                glm::all(glm::lessThan(glm::abs(place - 7.875), glm::dvec3(1.0))) ? 7 : 1);
        });
    session.plan->region = TissueRegion{"lesion"};
    session.tissues = {{1, "bone", {}, false}, {7, "lesion", {}, false}};
    const auto lesion = target_in_view(labelled, session);
    ASSERT_TRUE(lesion);
    EXPECT_EQ(lesion->centre_mm, glm::dvec3(7.875));
    EXPECT_DOUBLE_EQ(lesion->radius_mm, 0.5 * std::sqrt(3.0) * 1.75);
}

TEST(FirstView, BallRoundTwoIsTheSmallest) {
    const BallInView both = round_both({{0.0, 0.0, 0.0}, 1.0}, {{4.0, 0.0, 0.0}, 2.0});
    EXPECT_DOUBLE_EQ(both.radius_mm, 3.5);
    EXPECT_DOUBLE_EQ(both.centre_mm.x, 2.5);
    EXPECT_EQ(round_both({{0.0, 0.0, 0.0}, 9.0}, {{4.0, 0.0, 0.0}, 2.0}).radius_mm, 9.0);
}

}  // namespace
}  // namespace osteomill
