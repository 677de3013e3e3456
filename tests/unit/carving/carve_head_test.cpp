#include "simulation/carving/carve_head.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "common/scene/burr.h"
#include "tests/support/block.h"

namespace osteomill::carve_head_test {
namespace {

constexpr double spacing_mm = 0.1;

Bone block() {
    return testing::make_block({-4.0, -4.0, -4.0}, {4.0, 4.0, 4.0}, spacing_mm);
}

class CountedLevels final : public RemovalSink {
  public:
    void take(const RemovedVoxels& removed) noexcept override { levels += removed.lost_levels(); }
    double levels = 0.0;
};

struct Motion {
    BurrProfile profile;
    glm::dvec3 axis;
    glm::dvec3 from;
    glm::dvec3 to;

    HeadSweep sweep() const { return {profile, burr_frame(axis), from, to}; }
};

/// In voxels of the block, whose middle is at (40, 40, 40).
Motion random_motion(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    constexpr std::array shapes{HeadShape::cylinder, HeadShape::cone, HeadShape::barrel, HeadShape::pear};
    const double diameter_mm = 1.0 + 2.0 * share(random);
    const HeadShape shape = shapes[static_cast<std::size_t>(4.0 * share(random))];
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(share(random) - 0.5, share(random) - 0.5, share(random) - 0.5));
    };
    const glm::dvec3 middle = glm::dvec3(40.0) + 20.0 * direction();
    const glm::dvec3 path = 12.0 * share(random) * direction();
    return {BurrProfile(usual_head(shape, diameter_mm, diameter_mm * (1.0 + share(random))), diameter_mm,
                        1.0 / spacing_mm),
            direction(), middle - 0.5 * path, middle + 0.5 * path};
}

/// The distance from a sweep by brute force.
double nearest_of_many(const Motion& motion, const glm::dvec3& point) {
    const glm::dmat3 to_burr = glm::transpose(burr_frame(motion.axis));
    double least = 1e9;
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
        const glm::dvec3 at = motion.from + (motion.to - motion.from) * (static_cast<double>(i) / steps);
        const glm::dvec3 p = to_burr * (point - at);
        least = std::min(least, motion.profile.nearest(std::hypot(p.x, p.y), p.z).distance);
    }
    return least;
}

TEST(CarveHead, LeavesWhatLiesOutsideTheAnalyticSweep) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 8; ++trial) {
        const Motion motion = random_motion(random);
        Bone bone = block();
        ForgottenChanges changes;
        CountedLevels removed;
        carve_head(bone, motion.sweep(), CarveSettings{}, changes, removed);
        double kept = 0.0, worst_voxels = 0.0;
        const BoneContent& content = bone.content();
        for (std::size_t slot = 0; slot < content.brick_of_slot.size(); ++slot) {
            const glm::ivec3 corner =
                brick_position(content.size_bricks, content.brick_of_slot[slot]) * brick_edge_voxels;
            const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
            for (std::size_t offset = 0; offset < brick_voxel_count; offset += 41) {
                const glm::ivec3 voxel = corner + voxel_in_brick(offset);
                if (!contains(bone.grid(), voxel)) continue;
                const double distance = nearest_of_many(motion, glm::dvec3(voxel));
                const double levels = level_left_at(VoxelCoverage::smoothed, distance);
                // A level is at most 1/255 of a voxel of distance.
                worst_voxels = std::max(worst_voxels, std::abs(levels - fractions[offset]) / 255.0);
                kept += fractions[offset];
            }
        }
        EXPECT_GT(kept, 0.0);
        EXPECT_LT(worst_voxels, 0.03) << "trial " << trial << ": the promise is half a voxel";
        EXPECT_GT(removed.levels, 0.0);
    }
}

TEST(CarveHead, IsTheSameInOneStepOrInMany) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 8; ++trial) {
        const Motion motion = random_motion(random);
        Bone once = block();
        Bone many = block();
        ForgottenChanges changes;
        CountedLevels of_once, of_many;
        carve_head(once, motion.sweep(), CarveSettings{}, changes, of_once);
        for (int i = 0; i < 17; ++i) {
            const auto at = [&](int step) { return motion.from + (motion.to - motion.from) * (step / 17.0); };
            carve_head(many, {motion.profile, burr_frame(motion.axis), at(i), at(i + 1)}, CarveSettings{},
                       changes, of_many);
        }
        carve_head(many, motion.sweep(), CarveSettings{}, changes, of_many);
        EXPECT_NEAR(of_once.levels / of_many.levels, 1.0, 1e-3);
        EXPECT_NEAR((bone_volume_mm3(block()) - bone_volume_mm3(many)) / std::pow(spacing_mm, 3) * 255.0,
                    of_many.levels, 1.0)
            << "what was removed is old minus new";
    }
}

TEST(CarveHead, TakesTheSameAsTheBall) {
    Bone by_ball = block();
    Bone by_head = block();
    ForgottenChanges changes;
    CountedLevels of_ball, of_head;
    const BurrProfile ball({}, 2.3, 1.0 / spacing_mm);
    const glm::dvec3 from(33.2, 41.7, 60.3), to(45.9, 38.1, 55.2);
    carve(by_ball, {from, to, 11.5}, CarveHistory::none, {}, changes, of_ball);
    carve_head(by_head, {ball, burr_frame({0.6, 0.0, 0.8}), from, to}, CarveSettings{}, changes, of_head);
    EXPECT_NEAR(of_head.levels / of_ball.levels, 1.0, 1e-4);
}

TEST(CarveHead, LooksNowhereFarFromTheBone) {
    Bone bone = block();
    ForgottenChanges changes;
    CountedLevels removed;
    const BurrProfile head(usual_head(HeadShape::cylinder, 2.0, 6.0), 2.0, 1.0 / spacing_mm);
    for (const double far : {500.0, -1e6, 1e12})
        carve_head(bone, {head, burr_frame({0.0, 0.0, 1.0}), {far, far, 3.0}, {far, far + 40.0, 3.0}},
                   CarveSettings{}, changes, removed);
    EXPECT_EQ(removed.levels, 0.0);
}

}  // namespace
}  // namespace osteomill::carve_head_test
