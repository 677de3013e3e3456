#include "simulation/carving/carve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/block.h"

namespace osteomill {
namespace {

using testing::make_block;

constexpr double spacing_mm = 0.1;
constexpr double radius_mm = 1.0;

Bone block() {
    return make_block({-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0}, spacing_mm);
}

Sweep in_voxels(const Bone& bone, const glm::dvec3& from_mm, const glm::dvec3& to_mm) {
    return {to_voxel_coordinates(bone.grid(), from_mm), to_voxel_coordinates(bone.grid(), to_mm),
            radius_mm / spacing_mm};
}

/// Forgets what was removed, but counts its levels.
class Count final : public RemovalSink {
  public:
    void take(const RemovedVoxels& removed) noexcept override {
        for (std::size_t i = 0; i < removed.count; ++i) levels += static_cast<int>(removed.levels[i]);
    }
    int levels = 0;
};

void carve_path(Bone& bone, const std::vector<glm::dvec3>& path_mm) {
    ForgottenChanges changes;
    Count removed;
    for (std::size_t i = 0; i + 1 < path_mm.size(); ++i)
        carve(bone, in_voxels(bone, path_mm[i], path_mm[i + 1]),
              i == 0 ? CarveHistory::none : CarveHistory::carved_at_from, {}, changes, removed);
}

std::vector<glm::dvec3> subdivided(const std::vector<glm::dvec3>& path, int parts) {
    std::vector<glm::dvec3> fine{path.front()};
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        for (int part = 1; part <= parts; ++part)
            fine.push_back(path[i] + (path[i + 1] - path[i]) * (static_cast<double>(part) / parts));
    return fine;
}

const std::vector<glm::dvec3> zigzag{{-1.5, -1.0, 0.3}, {1.2, -0.4, 0.0}, {-0.6, 1.1, -0.8}, {0.9, 1.3, 1.1}};

TEST(Carve, RemovesTheSweptVolumeWithinAHalfPercent) {
    for (const glm::dvec3 to : {glm::dvec3(0.0), glm::dvec3(1.5, 0.0, 0.0), glm::dvec3(0.7, -1.1, 0.9)}) {
        Bone bone = block();
        const double before = bone_volume_mm3(bone);
        ForgottenChanges changes;
        Count removed;
        const glm::dvec3 from(-0.033, 0.021, 0.017);
        carve(bone, in_voxels(bone, from, to), CarveHistory::none, {}, changes, removed);
        const double swept = volume(Sweep{from, to, radius_mm});
        EXPECT_NEAR((before - bone_volume_mm3(bone)) / swept, 1.0, 0.005);
    }
}

TEST(Carve, DoesNotDependOnTheNumberOfSteps) {
    Bone coarse = block();
    carve_path(coarse, zigzag);
    for (const int parts : {2, 10, 137}) {
        Bone fine = block();
        carve_path(fine, subdivided(zigzag, parts));
        EXPECT_EQ(checksum(fine), checksum(coarse)) << parts << " steps for one";
    }
}

TEST(Carve, DoesNotDependOnTheOrderOfSteps) {
    Bone forward = block();
    carve_path(forward, zigzag);
    Bone backward = block();
    carve_path(backward, {zigzag.rbegin(), zigzag.rend()});
    EXPECT_EQ(checksum(forward), checksum(backward));
}

TEST(Carve, DoneTwiceRemovesNothingMore) {
    Bone bone = block();
    carve_path(bone, zigzag);
    const std::uint64_t once = checksum(bone);
    carve_path(bone, zigzag);
    EXPECT_EQ(checksum(bone), once);
}

TEST(Carve, CrescentAloneEqualsTheFullSearch) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> step(-0.15, 0.15);
    Bone crescent = block();
    Bone full = block();
    ForgottenChanges changes;
    Count removed;
    glm::dvec3 from(0.0);
    carve(crescent, in_voxels(crescent, from, from), CarveHistory::none, {}, changes, removed);
    carve(full, in_voxels(full, from, from), CarveHistory::none, {}, changes, removed);
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 to =
            glm::clamp(from + glm::dvec3(step(random), step(random), i % 3 ? step(random) : 0.0), -3.5, 3.5);
        carve(crescent, in_voxels(crescent, from, to), CarveHistory::carved_at_from, {}, changes, removed);
        carve(full, in_voxels(full, from, to), CarveHistory::none, {}, changes, removed);
        from = to;
    }
    EXPECT_EQ(checksum(crescent), checksum(full));
}

/// Applies the formula of voxel_coverage.h to every voxel, one by one in double precision.
void carve_voxel_by_voxel(Bone& bone, const Sweep& sweep, VoxelCoverage coverage) {
    const SweepSeenFrom seen(sweep, glm::dvec3(0.0), coverage);
    const glm::ivec3 size = bone.grid().size_voxels;
    glm::ivec3 v;
    for (v.z = 0; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x) {
                std::uint8_t& fraction = bone.fractions(bone.slot(v >> 4))[offset_in_brick(v)];
                const glm::vec3 position(v);
                const std::int32_t left =
                    coverage == VoxelCoverage::linear
                        ? level_left<VoxelCoverage::linear>(seen, position.x, position.y, position.z)
                    : coverage == VoxelCoverage::smoothed
                        ? level_left<VoxelCoverage::smoothed>(seen, position.x, position.y, position.z)
                        : level_left<VoxelCoverage::binary>(seen, position.x, position.y, position.z);
                fraction = static_cast<std::uint8_t>(std::min<int>(fraction, left));
            }
}

TEST(Carve, LeavesOfEachVoxelWhatTheFormulaSays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::uniform_real_distribution<double> step(-1.1, 1.1);
    // The larger the burr, the less single precision knows of its surface.
    for (const double radius : {0.4, 5.0, 25.0, 249.0})
        for (const VoxelCoverage coverage :
             {VoxelCoverage::linear, VoxelCoverage::smoothed, VoxelCoverage::binary})
            for (const InstructionSet instructions : {InstructionSet::plain, best_instruction_set()}) {
                Bone bone = make_block({0.0, 0.0, 0.0}, {3.5, 3.3, 3.4}, spacing_mm);
                Bone expected = bone;
                ForgottenChanges changes;
                Count removed;
                for (int i = 0; i < 6; ++i) {
                    const glm::dvec3 hit = glm::dvec3(part(random), part(random), part(random)) * 33.0;
                    const glm::dvec3 from = hit - radius * glm::normalize(glm::dvec3(1.0, 2.0, part(random)));
                    const glm::dvec3 to = from + glm::dvec3(step(random), step(random), step(random));
                    carve(bone, {from, to, radius}, CarveHistory::none,
                          {.coverage = coverage, .instructions = instructions}, changes, removed);
                    carve_voxel_by_voxel(expected, {from, to, radius}, coverage);
                }
                EXPECT_EQ(checksum(bone), checksum(expected)) << "radius " << radius << " voxels";
                EXPECT_GT(removed.levels, 0);
            }
}

TEST(Carve, ChangesRebuildTheBoneInAnotherCopy) {
    class Apply final : public ChangeSink {
      public:
        explicit Apply(Bone& copy) : copy_(copy) {}
        void push(const BrickChange& change, BrickFractions fractions) noexcept override {
            EXPECT_TRUE(change.voxels.any());
            expect_rows_end_where_bone_went(change, fractions);
            EXPECT_TRUE(apply(change, fractions, copy_));
        }

      private:
        /// Voxels between two that lost bone may be in a change, but none beyond them.
        void expect_rows_end_where_bone_went(const BrickChange& change, BrickFractions fractions) const {
            const BrickFractions before = std::as_const(copy_).fractions(copy_.slot(change.brick));
            const auto is_in_row_and_set = [&](std::size_t row, std::size_t voxel) {
                return voxel / brick_edge_voxels == row && change.voxels[voxel];
            };
            change.voxels.for_each([&](std::size_t voxel) {
                const std::size_t row = voxel / brick_edge_voxels;
                if (is_in_row_and_set(row, voxel - 1) && is_in_row_and_set(row, voxel + 1)) return;
                EXPECT_LT(fractions[voxel], before[voxel]);
            });
        }

        Bone& copy_;
    };
    Bone bone = block();
    Bone copy = bone;
    Apply changes(copy);
    const auto fine = subdivided(zigzag, 40);
    Count removed_levels;
    for (std::size_t i = 0; i + 1 < fine.size(); ++i)
        carve(bone, in_voxels(bone, fine[i], fine[i + 1]), CarveHistory::carved_at_from, {}, changes,
              removed_levels);
    EXPECT_EQ(checksum(copy), checksum(bone));
    const double removed = bone_volume_mm3(block()) - bone_volume_mm3(bone);
    EXPECT_NEAR(removed_levels.levels / 255.0 * voxel_volume_mm3(bone.grid()), removed, 1e-9);
}

TEST(Carve, OutsideTheGridDoesNothing) {
    Bone bone = block();
    const std::uint64_t before = checksum(bone);
    carve_path(bone, {{50.0, 0.0, 0.0}, {60.0, 0.0, 0.0}, {1e12, -1e12, 4.2}});
    EXPECT_EQ(checksum(bone), before);
}

TEST(Carve, IsWhatALookAheadTellsAndTheLookLeavesTheBoneAlone) {
    Bone bone = block();
    carve_path(bone, {{-1.0, 0.0, 0.0}, {0.0, 0.2, 0.1}});
    const std::uint64_t before = checksum(bone);
    const Sweep ahead = in_voxels(bone, {0.0, 0.2, 0.1}, {0.06, 0.25, 0.05});
    Count seen;
    preview_carve(bone, ahead, {}, seen);
    EXPECT_EQ(checksum(bone), before);
    ForgottenChanges changes;
    Count removed;
    carve(bone, ahead, CarveHistory::carved_at_from, {}, changes, removed);
    EXPECT_GT(seen.levels, 0);
    EXPECT_EQ(seen.levels, removed.levels);
}

}  // namespace
}  // namespace osteomill
