#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "render_client/ui/panels/picture_marks.h"
#include "studies/render/made_bone.h"

namespace osteomill::touch_ring_test {
namespace {

constexpr double radius_mm = 1.0;

/// Its upper face is at z = 0.
Bone block() {
    return made_bone({.size_voxels = {60, 60, 30}, .spacing_mm = 0.2, .origin_mm = {-5.9, -5.9, -4.9}},
                     [](const glm::dvec3& p) { return -p.z; });
}

std::ptrdiff_t seen(const std::optional<TouchRing>& ring) {
    return ring ? std::ranges::count_if(*ring, [](const auto& corner) { return corner.has_value(); }) : 0;
}

std::ptrdiff_t seen_from(const glm::dvec3& eye_mm, const std::vector<CutPlane>& cuts = {}) {
    const ToolState tool{.burr_position_mm = {0.0, 0.0, 3.0}};
    return seen(touch_ring(block(), tool, radius_mm, eye_mm, cuts));
}

TEST(TouchRing, LiesOnTheBoneAsLargeAsTheBurr) {
    const auto ring =
        touch_ring(block(), {.burr_position_mm = {0.0, 0.0, 3.0}}, radius_mm, {100.0, 0.0, 80.0}, {});
    ASSERT_EQ(seen(ring), 32);
    for (const auto& corner : *ring) {
        EXPECT_NEAR(corner->z, 0.0, 0.1);
        EXPECT_NEAR(glm::length(glm::dvec2(*corner)), radius_mm, 1e-9);
    }
}

TEST(TouchRing, IsHiddenByTheBurrThatStandsBeforeIt) {
    EXPECT_EQ(seen_from({0.0, 0.0, 50.0}), 0) << "from above the burr hides all";
    EXPECT_EQ(seen_from({100.0, 0.0, 20.0}), 32) << "from the side nothing";
    const auto partly = seen_from({40.0, 0.0, 80.0});
    EXPECT_GT(partly, 5);
    EXPECT_LT(partly, 32);
}

TEST(TouchRing, IsNotWhereACutHasTakenTheBoneAway) {
    const CutPlane hides_half{.normal = {0.0, 1.0, 0.0}, .offset_mm = 0.5};
    const CutPlane hides_all{.normal = {0.0, 0.0, 1.0}, .offset_mm = -1.0};
    const auto half = seen_from({100.0, 0.0, 20.0}, {hides_half});
    EXPECT_GT(half, 16);
    EXPECT_LT(half, 32);
    EXPECT_EQ(seen_from({100.0, 0.0, 20.0}, {hides_all}), 0);
}

}  // namespace
}  // namespace osteomill::touch_ring_test
