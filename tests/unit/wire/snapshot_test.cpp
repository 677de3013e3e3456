#include "common/wire/snapshot.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"
#include "tests/support/block.h"
#include "tests/support/speckled_bone.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

struct Messages {
    v2::SnapshotBegin begin;
    std::vector<v2::SnapshotBricks> pieces;
    v2::SnapshotEnd end;
};

Messages messages_of(const Bone& bone) {
    Messages messages{.begin = snapshot_begin(bone), .pieces = {}, .end = {}};
    SnapshotPacker packer;
    for (std::size_t slot = 0; slot < bone.stored_bricks();) {
        messages.pieces.push_back(packer.pack(bone, slot));
        slot += static_cast<std::size_t>(messages.pieces.back().brick_size());
    }
    messages.end.set_checksum(checksum(bone));
    return messages;
}

std::variant<Bone, WireError> assemble(const Messages& messages) {
    auto begun = SnapshotAssembler::begin(messages.begin);
    if (const auto* error = std::get_if<WireError>(&begun)) return *error;
    auto& assembler = std::get<SnapshotAssembler>(begun);
    for (const v2::SnapshotBricks& piece : messages.pieces)
        if (const auto error = assembler.add(piece)) return *error;
    return std::move(assembler).finish(messages.end);
}

std::string error_of(const Messages& messages) {
    const auto result = assemble(messages);
    const auto* error = std::get_if<WireError>(&result);
    return error == nullptr ? "" : error->line;
}

void expect_equal(const Bone& a, const Bone& b) {
    EXPECT_EQ(a.grid(), b.grid());
    EXPECT_EQ(a.content().brick_of_slot, b.content().brick_of_slot);
    EXPECT_EQ(a.content().stiffness, b.content().stiffness);
    EXPECT_EQ(a.content().tissue, b.content().tissue);
    EXPECT_EQ(a.content().homogeneous_stiffness, b.content().homogeneous_stiffness);
    EXPECT_EQ(a.content().stiffness_per_code, b.content().stiffness_per_code);
    EXPECT_EQ(checksum(a), checksum(b));
}

void put_channels(const std::vector<std::uint8_t>& channels, v2::SnapshotBricks& piece) {
    std::string compressed(ZSTD_compressBound(channels.size()), '\0');
    compressed.resize(
        ZSTD_compress(compressed.data(), compressed.size(), channels.data(), channels.size(), 1));
    piece.set_zstd_channels(compressed);
}

Messages of_a_small_block() {
    return messages_of(testing::make_block({0, 0, 0}, {2.0, 2.0, 2.0}, 0.1));
}

TEST(Snapshot, BringsBackBonesOfEveryKindBitForBit) {
    std::mt19937 random(3);
    for (const bool heterogeneous : {false, true})
        for (const bool labelled : {false, true}) {
            const Bone bone = testing::make_speckled_bone(
                random, {.heterogeneous = heterogeneous, .labelled = labelled, .filled_bricks = 0.7});
            const auto result = assemble(messages_of(bone));
            ASSERT_TRUE(std::holds_alternative<Bone>(result)) << std::get<WireError>(result).line;
            expect_equal(std::get<Bone>(result), bone);
        }
}

TEST(Snapshot, FitsFramesEvenWhereNothingCompresses) {
    std::mt19937 random(4);
    for (const bool heterogeneous : {false, true}) {
        const Bone bone = testing::make_speckled_bone(random, {.grid = {.size_voxels = {160, 160, 64}},
                                                               .heterogeneous = heterogeneous,
                                                               .labelled = heterogeneous,
                                                               .filled_bricks = 1.0});
        for (const v2::SnapshotBricks& piece : messages_of(bone).pieces) {
            v2::ServerFrame frame;
            frame.set_sequence(~std::uint64_t{0});
            *frame.mutable_snapshot_bricks() = piece;
            EXPECT_LE(frame.ByteSizeLong(), largest_frame_bytes);
        }
    }
}

TEST(Snapshot, OfABoneWithoutBricksIsEmpty) {
    const Bone bone = BoneBuilder::homogeneous({.size_voxels = {20, 20, 20}}, 1.0, false).build();
    const Messages messages = messages_of(bone);
    EXPECT_TRUE(messages.pieces.empty());
    EXPECT_EQ(error_of(messages), "");
}

TEST(Snapshot, RefusesAGridThatCannotBeHad) {
    Messages messages = of_a_small_block();
    messages.begin.mutable_grid()->set_size_x(4'000'000'000U);
    EXPECT_THAT(error_of(messages), HasSubstr("65536"));
    messages.begin.mutable_grid()->set_size_x(65536);
    messages.begin.mutable_grid()->set_size_y(65536);
    messages.begin.mutable_grid()->set_size_z(65536);
    EXPECT_THAT(error_of(messages), HasSubstr("bricks"));
    messages = of_a_small_block();
    messages.begin.mutable_grid()->set_spacing_mm(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(error_of(messages), HasSubstr("spacing"));
    messages = of_a_small_block();
    messages.begin.set_homogeneous_stiffness(-1.0);
    EXPECT_THAT(error_of(messages), HasSubstr("stiffness"));
    messages = of_a_small_block();
    messages.begin.set_brick_count(9);
    EXPECT_THAT(error_of(messages), HasSubstr("9 bricks are announced for a grid of 8"));
}

TEST(Snapshot, RefusesABoneThatWouldFillTheMemoryHoweverItCompresses) {
    v2::SnapshotBegin begin = of_a_small_block().begin;
    for (const auto set_size : {&v2::Grid::set_size_x, &v2::Grid::set_size_y, &v2::Grid::set_size_z})
        (begin.mutable_grid()->*set_size)(4000);
    begin.set_brick_count((1U << 20U) + 1);  // 4 KiB each
    EXPECT_THAT(error_of({.begin = begin, .pieces = {}, .end = {}}), HasSubstr("4096 MiB"));
    begin.set_brick_count(1U << 20U);
    EXPECT_THAT(error_of({.begin = begin, .pieces = {}, .end = {}}), HasSubstr("0 bricks came"));
    begin.set_labelled(true);
    EXPECT_THAT(error_of({.begin = begin, .pieces = {}, .end = {}}), HasSubstr("4096 MiB"));
}

TEST(Snapshot, RefusesPiecesThatDoNotAddUp) {
    Messages messages = of_a_small_block();
    messages.pieces[0].set_brick(3, 2);
    EXPECT_THAT(error_of(messages), HasSubstr("brick 2 comes after 2"));
    messages = of_a_small_block();
    messages.pieces[0].set_brick(7, 8);
    EXPECT_THAT(error_of(messages), HasSubstr("outside the grid"));
    messages = of_a_small_block();
    messages.pieces.clear();
    EXPECT_THAT(error_of(messages), HasSubstr("0 bricks came of the 8"));
    messages = of_a_small_block();
    messages.pieces.push_back(messages.pieces[0]);
    EXPECT_THAT(error_of(messages), HasSubstr("more bricks came"));
    messages = of_a_small_block();
    for (BrickIndex brick = 8; brick < 40; ++brick) messages.pieces[0].add_brick(brick);
    EXPECT_THAT(error_of(messages), HasSubstr("a piece holds 40 bricks"));
    messages = of_a_small_block();
    messages.pieces[0].clear_brick();
    EXPECT_THAT(error_of(messages), HasSubstr("a piece holds 0 bricks"));
}

TEST(Snapshot, RefusesChannelsOfTheWrongSizeHoweverTheyCompress) {
    Messages messages = of_a_small_block();
    put_channels(std::vector<std::uint8_t>(100), messages.pieces[0]);
    EXPECT_THAT(error_of(messages), HasSubstr("holds 100 bytes, not 32768"));
    put_channels(std::vector<std::uint8_t>(500'000'000), messages.pieces[0]);
    EXPECT_THAT(error_of(messages), HasSubstr("corrupt"));
    messages.pieces[0].set_zstd_channels("not zstd at all");
    EXPECT_THAT(error_of(messages), HasSubstr("corrupt"));
    messages.pieces[0].clear_zstd_channels();
    EXPECT_NE(error_of(messages), "");
}

TEST(Snapshot, RefusesBonePastTheGrid) {
    Messages messages = of_a_small_block();  // 20 voxels: the second brick holds 4 of 16
    put_channels(std::vector<std::uint8_t>(8 * brick_voxel_count, 255), messages.pieces[0]);
    EXPECT_THAT(error_of(messages), HasSubstr("past it"));
}

TEST(Snapshot, RefusesAWrongChecksum) {
    Messages messages = of_a_small_block();
    messages.end.set_checksum(messages.end.checksum() + 1);
    EXPECT_THAT(error_of(messages), HasSubstr("checksum"));
}

TEST(Snapshot, SurvivesAnyByteOfAPieceBeingWrong) {
    const Messages good = of_a_small_block();
    std::mt19937 random(5);
    std::string wire = good.pieces[0].SerializeAsString();
    for (std::size_t at = 0; at < wire.size(); ++at) {
        std::string damaged = wire;
        damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1U << random() % 8));
        Messages messages = good;
        if (!messages.pieces[0].ParseFromString(damaged)) continue;
        const auto result = assemble(messages);
        if (const auto* bone = std::get_if<Bone>(&result)) {
            EXPECT_EQ(checksum(*bone), good.end.checksum());
        }
    }
}

}  // namespace
}  // namespace osteomill
