#include "haptic_server/streaming/edit_guesser.h"

#include <gtest/gtest.h>

#include "haptic_server/carving/carve.h"
#include "tests/support/block.h"
#include "tests/support/mirror_sink.h"

namespace osteomill {
namespace {

class Nobody final : public RemovalSink {
  public:
    void take(const RemovedVoxels&) noexcept override {}
};

/// Bytes of what differs from the guess when milling takes a burr of 9 voxels by two voxels into a block.
std::size_t bytes_of_carving(VoxelCoverage coverage, double smoothing) {
    Bone bone = testing::make_block({0.0, 0.0, 0.0}, {48.0, 48.0, 32.0}, 1.0);
    BoneMirror mirror(bone);
    testing::MirrorSink edits(mirror);
    Nobody nobody;
    constexpr double radius = 9.0;
    const glm::dvec3 from(24.2, 23.1, 33.3), to(25.1, 24.0, 31.7);
    carve(bone, {from, from, radius}, CarveHistory::none, {.coverage = coverage}, edits, nobody);
    (void)mirror.take_changes();
    carve(bone, {from, to, radius}, CarveHistory::carved_at_from, {.coverage = coverage}, edits, nobody);
    std::vector<ChangedBrick> bricks;
    for (const auto& [brick, voxels] : mirror.take_changes()) bricks.push_back({brick, voxels});
    EditGuesser guesser;
    const BurrMotion shown{
        .from = from, .to = to + glm::dvec3(0.2, -0.1, 0.1), .radius = radius, .smoothing = smoothing};
    return guesser.guess(mirror, bricks, shown).edits.zstd_differences().size();
}

TEST(EditGuesser, GuessesBestByTheLawThatMillingCarvesBy) {
    constexpr double soft = smoothing_voxels(VoxelCoverage::smoothed);
    constexpr double sharp = smoothing_voxels(VoxelCoverage::linear);
    EXPECT_LT(2 * bytes_of_carving(VoxelCoverage::smoothed, soft),
              bytes_of_carving(VoxelCoverage::smoothed, sharp));
    EXPECT_LT(2 * bytes_of_carving(VoxelCoverage::linear, sharp),
              bytes_of_carving(VoxelCoverage::linear, soft));
}

}  // namespace
}  // namespace osteomill
