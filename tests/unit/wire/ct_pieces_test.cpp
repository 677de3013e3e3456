#include "common/wire/ct_pieces.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace osteomill {
namespace {

CtVolume made_ct(const glm::ivec3& size, std::uint32_t seed) {
    CtVolume ct{.grid = {.size_voxels = size, .spacing_mm = 0.4, .origin_mm = {1.0, -2.0, 3.5}}, .hu = {}};
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> hu(std::numeric_limits<std::int16_t>::min(),
                                          std::numeric_limits<std::int16_t>::max());
    ct.hu.resize(static_cast<std::size_t>(size.x * size.y * size.z));
    for (std::int16_t& value : ct.hu) value = static_cast<std::int16_t>(hu(random));
    return ct;
}

std::vector<v2::CtPiece> pieces_of(const CtVolume& ct) {
    CtPacker packer;
    std::vector<v2::CtPiece> pieces;
    for (std::size_t voxel = 0; voxel < ct.hu.size();) pieces.push_back(packer.pack(ct, voxel));
    return pieces;
}

std::string refusal(CtAssembler& assembler, const v2::CtPiece& piece) {
    const auto taken = assembler.take(piece);
    const auto* error = std::get_if<WireError>(&taken);
    return error != nullptr ? error->line : std::string();
}

TEST(CtPieces, BringEveryNumberInPiecesThatFitAFrame) {
    for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), glm::ivec3(32, 32, 32), glm::ivec3(61, 47, 40)}) {
        const CtVolume ct = made_ct(size, 5);
        CtAssembler assembler;
        std::shared_ptr<const CtVolume> arrived;
        for (const v2::CtPiece& piece : pieces_of(ct)) {
            EXPECT_FALSE(arrived);
            EXPECT_LT(piece.ByteSizeLong(), 100U * 1024U) << "random numbers do not compress";
            arrived = std::get<0>(assembler.take(piece));
        }
        ASSERT_TRUE(arrived);
        EXPECT_EQ(arrived->grid, ct.grid);
        EXPECT_EQ(arrived->hu, ct.hu);
    }
}

TEST(CtPieces, RefuseWhatMakesNoSense) {
    const std::vector<v2::CtPiece> pieces = pieces_of(made_ct({61, 47, 40}, 6));
    ASSERT_GT(pieces.size(), 3U);
    CtAssembler assembler;
    EXPECT_EQ(refusal(assembler, pieces[1]), "CT refused: a piece came without the first");
    EXPECT_EQ(refusal(assembler, pieces[0]), "");
    EXPECT_EQ(refusal(assembler, pieces[2]), "CT refused: a piece came out of order");
    EXPECT_EQ(refusal(assembler, pieces[1]), "CT refused: a piece came without the first");

    v2::CtPiece torn = pieces[0];
    torn.mutable_zstd_hu()->resize(100);
    EXPECT_EQ(refusal(assembler, torn), "CT refused: a piece cannot be unpacked");
    v2::CtPiece huge = pieces[0];
    huge.mutable_grid()->set_size_x(5000);
    huge.mutable_grid()->set_size_y(5000);
    EXPECT_EQ(refusal(assembler, huge), "CT refused: it has more than 8388608 voxels");
    v2::CtPiece impossible = pieces[0];
    impossible.mutable_grid()->set_spacing_mm(0.0);
    EXPECT_NE(refusal(assembler, impossible), "");
}

}  // namespace
}  // namespace osteomill
