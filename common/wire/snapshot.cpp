#include "common/wire/snapshot.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/wire/geometry_messages.h"
#include "osteomill/v2/bone.pb.h"

namespace osteomill {

namespace {

/// Fast enough to pack a bone while 30 frames a second go on beside it; higher levels gain little on bone.
constexpr int snapshot_compression_level = 1;

std::size_t channel_count(bool heterogeneous, bool labelled) {
    return std::size_t{1} + (heterogeneous ? 1 : 0) + (labelled ? 1 : 0);
}

std::size_t most_bricks_of_piece(std::size_t channels) {
    return largest_snapshot_piece_bytes / (channels * brick_voxel_count);
}

std::size_t brick_count(const Grid& grid) {
    const glm::ivec3 size = size_in_bricks(grid);
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
}

void require_within_limits(std::size_t stored_bricks, std::size_t channels) {
    const std::size_t bytes = stored_bricks * channels * brick_voxel_count;
    if (bytes > most_bytes_of_bone)
        throw std::invalid_argument("the bone takes " + std::to_string(bytes >> 20U) +
                                    " MiB, more than the " + std::to_string(most_bytes_of_bone >> 20U) +
                                    " MiB that are sent; crop or coarsen it");
}

ByteBrick brick_at(std::span<const std::uint8_t> channels, std::size_t position) {
    ByteBrick brick;
    std::copy_n(channels.begin() + static_cast<std::ptrdiff_t>(position * brick_voxel_count),
                brick_voxel_count, brick.begin());
    return brick;
}

WireError snapshot_refused(std::string what) {
    return {"snapshot refused: " + std::move(what)};
}

}  // namespace

void require_sendable(const Bone& bone) {
    const BoneContent& content = bone.content();
    require_within_limits(bone.stored_bricks(),
                          channel_count(!content.stiffness.empty(), !content.tissue.empty()));
}

v2::SnapshotBegin snapshot_begin(const Bone& bone) {
    const BoneContent& content = bone.content();
    v2::SnapshotBegin message;
    *message.mutable_grid() = to_message(content.grid);
    message.set_heterogeneous(!content.stiffness.empty());
    message.set_labelled(!content.tissue.empty());
    message.set_homogeneous_stiffness(content.homogeneous_stiffness);
    message.set_stiffness_per_code(content.stiffness_per_code);
    message.set_brick_count(static_cast<std::uint32_t>(bone.stored_bricks()));
    return message;
}

SnapshotPacker::SnapshotPacker() : compressor_(snapshot_compression_level) {
    channels_.reserve(largest_snapshot_piece_bytes);
}

v2::SnapshotBricks SnapshotPacker::pack(const Bone& bone, std::size_t first_slot) {
    const BoneContent& content = bone.content();
    const std::size_t most =
        most_bricks_of_piece(channel_count(!content.stiffness.empty(), !content.tissue.empty()));
    const std::size_t end = std::min(bone.stored_bricks(), first_slot + most);

    v2::SnapshotBricks message;
    channels_.clear();
    for (std::size_t slot = first_slot; slot < end; ++slot) {
        message.add_brick(content.brick_of_slot[slot]);
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        channels_.insert(channels_.end(), fractions.begin(), fractions.end());
        for (const auto* channel : {&content.stiffness, &content.tissue})
            if (!channel->empty())
                channels_.insert(channels_.end(), (*channel)[slot].begin(), (*channel)[slot].end());
    }
    const auto compressed = compressor_.compress(channels_);
    message.set_zstd_channels(compressed.data(), compressed.size());
    return message;
}

SnapshotAssembler::SnapshotAssembler(BoneBuilder builder, const v2::SnapshotBegin& message,
                                     const glm::ivec3& size_bricks)
    : builder_(std::move(builder)),
      size_bricks_(size_bricks),
      heterogeneous_(message.heterogeneous()),
      labelled_(message.labelled()),
      announced_(message.brick_count()) {}

std::variant<SnapshotAssembler, WireError> SnapshotAssembler::begin(const v2::SnapshotBegin& message) {
    const std::variant<Grid, WireError> parsed = grid_from(message.grid());
    if (const auto* error = std::get_if<WireError>(&parsed)) return snapshot_refused(error->line);
    const Grid& grid = std::get<Grid>(parsed);
    if (message.brick_count() > brick_count(grid))
        return snapshot_refused(std::to_string(message.brick_count()) +
                                " bricks are announced for a grid of " + std::to_string(brick_count(grid)));
    try {
        require_within_limits(message.brick_count(),
                              channel_count(message.heterogeneous(), message.labelled()));
        auto builder =
            message.heterogeneous()
                ? BoneBuilder::heterogeneous(grid, message.stiffness_per_code(), message.labelled())
                : BoneBuilder::homogeneous(grid, message.homogeneous_stiffness(), message.labelled());
        // Bricks that are announced and never come cost addresses, not memory.
        builder.reserve_bricks(message.brick_count());
        return SnapshotAssembler(std::move(builder), message, size_in_bricks(grid));
    } catch (const std::invalid_argument& error) {
        return snapshot_refused(error.what());
    } catch (const std::bad_alloc&) {
        return snapshot_refused("there is no room for the " + std::to_string(message.brick_count()) +
                                " bricks announced");
    }
}

std::optional<WireError> SnapshotAssembler::add(const v2::SnapshotBricks& message) {
    const std::size_t channels = channel_count(heterogeneous_, labelled_);
    const auto bricks = static_cast<std::size_t>(message.brick_size());
    if (bricks == 0 || bricks > most_bricks_of_piece(channels))
        return snapshot_refused("a piece holds " + std::to_string(bricks) + " bricks, not 1 to " +
                                std::to_string(most_bricks_of_piece(channels)));
    if (bricks > announced_ - received_)
        return snapshot_refused("more bricks came than the " + std::to_string(announced_) + " announced");

    channels_.resize(bricks * channels * brick_voxel_count);
    const std::size_t size = ZSTD_decompress(channels_.data(), channels_.size(),
                                             message.zstd_channels().data(), message.zstd_channels().size());
    if (ZSTD_isError(size))
        return snapshot_refused(std::string("a piece is corrupt: ") + ZSTD_getErrorName(size));
    if (size != channels_.size())
        return snapshot_refused("a piece holds " + std::to_string(size) + " bytes, not " +
                                std::to_string(channels_.size()));

    const glm::uvec3 table(size_bricks_);
    for (std::size_t i = 0; i < bricks; ++i) {
        const BrickIndex brick = message.brick(static_cast<int>(i));
        if (static_cast<std::int64_t>(brick) <= last_brick_)
            return snapshot_refused("brick " + std::to_string(brick) + " comes after " +
                                    std::to_string(last_brick_));
        if (brick >= static_cast<std::uint64_t>(table.x) * table.y * table.z)
            return snapshot_refused("brick " + std::to_string(brick) + " lies outside the grid");
        last_brick_ = brick;

        std::size_t next = i * channels;
        const ByteBrick fraction = brick_at(channels_, next++);
        const ByteBrick stiffness = heterogeneous_ ? brick_at(channels_, next++) : ByteBrick{};
        const ByteBrick tissue = labelled_ ? brick_at(channels_, next) : ByteBrick{};
        try {
            builder_.add_brick(brick_position(size_bricks_, brick), fraction,
                               heterogeneous_ ? &stiffness : nullptr, labelled_ ? &tissue : nullptr);
        } catch (const std::invalid_argument& error) {
            return snapshot_refused(error.what());
        }
    }
    received_ += static_cast<std::uint32_t>(bricks);
    return std::nullopt;
}

std::variant<Bone, WireError> SnapshotAssembler::finish(const v2::SnapshotEnd& message) && {
    if (received_ != announced_)
        return snapshot_refused(std::to_string(received_) + " bricks came of the " +
                                std::to_string(announced_) + " announced");
    Bone bone = std::move(builder_).build();
    if (checksum(bone) != message.checksum()) return snapshot_refused("its checksum does not hold");
    return bone;
}

}  // namespace osteomill
