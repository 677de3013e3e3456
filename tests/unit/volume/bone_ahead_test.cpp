#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <vector>

#include "render_client/volume/surface_points.h"
#include "studies/render/made_bone.h"

namespace osteomill::bone_ahead_test {
namespace {

const glm::dvec3 centre_mm(10.0, -4.0, 20.0);
constexpr double radius_mm = 5.0;

Bone ball() {
    return made_bone({.size_voxels = {60, 60, 60}, .spacing_mm = 0.2, .origin_mm = centre_mm - 5.9},
                     [](const glm::dvec3& p) { return radius_mm - glm::distance(p, centre_mm); });
}

TEST(BoneAhead, IsAsFarAsTheBurrWouldGo) {
    const Bone bone = ball();
    const auto ahead = [&](double above_mm) {
        return bone_ahead_mm(bone, {.burr_position_mm = centre_mm + glm::dvec3(0.0, 0.0, above_mm)}, 1.0);
    };
    EXPECT_NEAR(ahead(9.0).value(), 3.0, 0.05);
    EXPECT_NEAR(ahead(6.0).value(), 0.0, 0.1);
    EXPECT_FALSE(ahead(26.0)) << "too far";
    EXPECT_FALSE(bone_ahead_mm(bone, {.burr_position_mm = centre_mm + glm::dvec3(8.0, 0.0, 9.0)}, 1.0))
        << "it would pass";
}

TEST(BoneAhead, HidesWhatLiesBehindIt) {
    const Bone bone = ball();
    const glm::dvec3 eye_mm = centre_mm + glm::dvec3(0.0, 0.0, 100.0);
    EXPECT_FALSE(is_behind_bone(bone, eye_mm, centre_mm + glm::dvec3(0.0, 0.0, radius_mm)));
    EXPECT_TRUE(is_behind_bone(bone, eye_mm, centre_mm - glm::dvec3(0.0, 0.0, radius_mm)));
    EXPECT_FALSE(is_behind_bone(bone, eye_mm, centre_mm + glm::dvec3(9.0, 0.0, 0.0)));
    const std::vector<CutPlane> cuts{{.normal = {0.0, 0.0, 1.0}, .offset_mm = centre_mm.z - 4.5}};
    EXPECT_FALSE(is_behind_bone(bone, eye_mm, centre_mm - glm::dvec3(0.0, 0.0, radius_mm), cuts))
        << "what a cut hides, hides nothing";
}

}  // namespace
}  // namespace osteomill::bone_ahead_test
