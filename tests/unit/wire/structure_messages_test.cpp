#include "common/wire/structure_messages.h"

#include <gtest/gtest.h>

#include <random>

#include "common/wire/frame.h"
#include "common/wire/zstd_compressor.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {
namespace {

/// 16 x 16 x 4 bricks.
const Grid grid{.size_voxels = {250, 256, 64}, .spacing_mm = 0.1, .origin_mm = {1.0, 2.0, 3.0}};
const std::vector<Tissue> tissues{{.label = 1, .name = "bone"},
                                  {.label = 2, .name = "nerve", .is_protected = true},
                                  {.label = 3, .name = "sinus", .is_protected = true}};

/// Random voxels: they do not compress.
Structure noise(std::size_t tissue, BrickIndex step, std::uint32_t seed) {
    std::mt19937_64 random(seed);
    std::vector<StructureBrick> bricks;
    const glm::ivec3 size = size_in_bricks(grid);
    for (BrickIndex brick = 0; brick < static_cast<BrickIndex>(size.x * size.y * size.z); brick += step) {
        VoxelMask voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (random() % 2 == 0 &&
                contains(grid, brick_edge_voxels * brick_position(size, brick) + voxel_in_brick(offset)))
                voxels.set(offset);
        bricks.push_back({brick, voxels});
    }
    return {tissue, StructureMask(grid, std::move(bricks))};
}

std::string refusal(StructureAssembler& assembler, const v2::StructureBricks& piece) {
    const auto taken = assembler.take(piece);
    const auto* error = std::get_if<WireError>(&taken);
    return error != nullptr ? error->line : std::string();
}

TEST(StructureBricks, BringEveryVoxelInPiecesThatFitAFrame) {
    const std::vector<Structure> sent{noise(1, 1, 4), noise(2, 300, 5)};
    StructureAssembler assembler(tissues, grid);
    std::vector<Structure> arrived;
    for (const v2::StructureBricks& piece : structure_pieces(sent)) {
        EXPECT_LT(piece.ByteSizeLong() + 100, largest_frame_bytes);
        auto taken = std::get<0>(assembler.take(piece));
        if (taken) arrived.push_back(*std::move(taken));
    }
    ASSERT_EQ(arrived.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(arrived[i].tissue, sent[i].tissue);
        EXPECT_TRUE(arrived[i].mask == sent[i].mask);
    }
    // A recording that is wound back brings them once more.
    for (const v2::StructureBricks& piece : structure_pieces(sent))
        EXPECT_FALSE(std::get<0>(assembler.take(piece)));
}

TEST(StructureBricks, OfNothingAreNone) {
    EXPECT_TRUE(structure_pieces({}).empty());
    EXPECT_TRUE(structure_pieces(std::vector<Structure>{{1, StructureMask(grid, {})}}).empty());
}

TEST(StructureBricks, RefuseWhatMakesNoSense) {
    const auto pieces = structure_pieces(std::vector<Structure>{noise(1, 1, 4)});
    ASSERT_GT(pieces.size(), 3u);
    StructureAssembler assembler(tissues, grid);
    const auto with = [&](auto&& change, std::size_t i = 0) {
        v2::StructureBricks piece = pieces[i];
        change(piece);
        return refusal(assembler, piece);
    };
    const auto nothing = [](v2::StructureBricks&) {};
    EXPECT_EQ(with([](auto& p) { p.set_tissue(3); }),
              "structure refused: tissue 3 is not one of the scene's 3");
    EXPECT_EQ(with([](auto& p) { p.set_tissue(0); }), "structure refused: tissue 0 is not protected");
    EXPECT_EQ(with([](auto& p) { p.clear_brick(); }),
              "structure refused: a piece holds 0 bricks, not 1 to 128");
    EXPECT_EQ(with([](auto& p) { p.add_brick(9999); }),
              "structure refused: a piece holds 129 bricks, not 1 to 128");
    EXPECT_EQ(with([](auto& p) { p.set_brick(127, 16 * 16 * 4); }),
              "structure refused: brick 1024 lies outside the grid");
    EXPECT_EQ(with([](auto& p) { p.set_brick(1, 0); }), "structure refused: brick 0 comes after 0");
    EXPECT_EQ(with([](auto& p) { p.mutable_zstd_masks()->resize(100); }),
              "structure refused: a piece cannot be unpacked");
    EXPECT_EQ(with([](auto& p) { p.mutable_brick()->RemoveLast(); }),
              "structure refused: a piece cannot be unpacked");
    EXPECT_EQ(with(nothing), "");
    EXPECT_EQ(with([](auto& p) { p.set_tissue(2); }, 1),
              "structure refused: another began before it was complete");
    EXPECT_EQ(with(nothing, 1), "") << "begun anew";
    EXPECT_EQ(with(nothing, 0), "structure refused: brick 0 comes after 255");
}

TEST(StructureBricks, RefuseBricksWithoutAVoxelAndVoxelsPastTheGrid) {
    const Grid wide{.size_voxels = {256, 256, 64}, .spacing_mm = 0.1, .origin_mm = {1.0, 2.0, 3.0}};
    const auto packed = [&](VoxelMask voxels) {
        v2::StructureBricks piece =
            structure_pieces(std::vector<Structure>{{1, StructureMask(wide, {{15, voxels}})}}).at(0);
        return piece;
    };
    StructureAssembler assembler(tissues, grid);
    EXPECT_EQ(refusal(assembler, packed(VoxelMask().set(15))),
              "structure refused: structure: a voxel of brick 15 lies past the grid's edge");
    v2::StructureBricks empty = packed(VoxelMask().set(3));
    ZstdCompressor compressor(1);
    const std::vector<std::uint8_t> zeros(512);
    const auto bytes = compressor.compress(zeros);
    empty.set_zstd_masks(bytes.data(), bytes.size());
    EXPECT_EQ(refusal(assembler, empty), "structure refused: brick 15 has no voxel");
    EXPECT_EQ(refusal(assembler, packed(VoxelMask().set(3))), "");
}

TEST(StructureBricks, AreBoundedInAll) {
    // A grid of 2^24 bricks: twice as many whole bricks as anybody may send are kilobytes on the wire.
    const Grid huge{.size_voxels = glm::ivec3(4096), .spacing_mm = 0.1, .origin_mm = {}};
    StructureAssembler assembler(tissues, huge);
    v2::StructureBricks piece;
    piece.set_tissue(1);
    ZstdCompressor compressor(1);
    const std::vector<std::uint8_t> ones(128 * 512, 0xFF);
    const auto bytes = compressor.compress(ones);
    piece.set_zstd_masks(bytes.data(), bytes.size());
    std::string refused;
    BrickIndex brick = 0;
    for (std::size_t i = 0; refused.empty() && i <= most_structure_bricks / 128; ++i) {
        piece.clear_brick();
        for (int k = 0; k < 128; ++k) piece.add_brick(brick++);
        refused = refusal(assembler, piece);
    }
    EXPECT_EQ(refused, "structure refused: there are more than 262144 bricks");
}

}  // namespace
}  // namespace osteomill
