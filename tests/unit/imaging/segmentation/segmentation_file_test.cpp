#include "imaging/segmentation/segmentation_file.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <stdexcept>

#include "imaging/imaging_error.h"
#include "imaging/segmentation/segment_structure.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

const Grid grid{.size_voxels = {50, 40, 45}, .spacing_mm = 0.1, .origin_mm = {-3.0, 12.5, 700.1}};

StructureMask ball(const glm::dvec3& centre, double radius) {
    std::map<BrickIndex, VoxelMask> bricks;
    glm::ivec3 v;
    for (v.z = 0; v.z < grid.size_voxels.z; ++v.z)
        for (v.y = 0; v.y < grid.size_voxels.y; ++v.y)
            for (v.x = 0; v.x < grid.size_voxels.x; ++v.x)
                if (glm::distance(glm::dvec3(v), centre) < radius)
                    bricks[brick_index(size_in_bricks(grid), v / brick_edge_voxels)].set(
                        offset_in_brick(v % brick_edge_voxels));
    std::vector<StructureBrick> all;
    for (const auto& [brick, voxels] : bricks) all.push_back({brick, voxels});
    return {grid, std::move(all)};
}

TEST(SegmentationOnTheBonesGrid, IsReadAsItWasWrittenWhateverOverlaps) {
    const testing::TemporaryFolder folder;
    std::mt19937 random(2);
    const auto real = [&](double from, double to) {
        return std::uniform_real_distribution(from, to)(random);
    };
    for (int round = 0; round < 5; ++round) {
        std::vector<NamedStructure> written;
        for (int i = 0; i < 7; ++i) {
            StructureMask mask = ball({real(0, 50), real(0, 40), real(0, 45)}, real(2, 12));
            if (mask.empty()) continue;
            written.push_back({"structure " + std::to_string(i),
                               {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 7},
                               std::move(mask)});
        }
        write_segmentation(folder / "s.seg.nrrd", written);
        const Segmentation read = read_segmentation(folder / "s.seg.nrrd");
        ASSERT_EQ(read.segments.size(), written.size());
        EXPECT_FALSE(read.is_plain_map);
        for (std::size_t i = 0; i < written.size(); ++i) {
            EXPECT_EQ(read.segments[i].name, written[i].name);
            EXPECT_EQ(read.segments[i].colour_rgb, written[i].colour_rgb);
            EXPECT_EQ(structure_of(read, read.segments[i], grid), written[i].mask) << i;
        }
    }
}

TEST(SegmentationOnTheBonesGrid, LayersOnlyWhatOverlaps) {
    const testing::TemporaryFolder folder;
    const StructureMask left = ball({10, 20, 20}, 6);
    const StructureMask right = ball({35, 20, 20}, 6);
    write_segmentation(folder / "apart.seg.nrrd", {{"left", {}, left}, {"right", {}, right}});
    EXPECT_EQ(read_segmentation(folder / "apart.seg.nrrd").labels.layers(), 1);
    write_segmentation(folder / "over.seg.nrrd",
                       {{"left", {}, left}, {"both", {}, ball({22, 20, 20}, 15)}, {"right", {}, right}});
    const Segmentation over = read_segmentation(folder / "over.seg.nrrd");
    EXPECT_EQ(over.labels.layers(), 2);
    EXPECT_EQ(over.segments[2].layer, 0);
}

TEST(SegmentationOnTheBonesGrid, IsNotMadeOfNothing) {
    const testing::TemporaryFolder folder;
    EXPECT_THROW(write_segmentation(folder / "s.seg.nrrd", {}), std::invalid_argument);
    EXPECT_THROW(write_segmentation(folder / "s.seg.nrrd", {{"none", {}, StructureMask(grid, {})}}),
                 std::invalid_argument);
    EXPECT_THROW(write_segmentation(folder / "no" / "s.seg.nrrd", {{"a", {}, ball({9, 9, 9}, 4)}}),
                 std::runtime_error);
}

}  // namespace
}  // namespace osteomill
