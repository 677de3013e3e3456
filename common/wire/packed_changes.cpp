#include "common/wire/packed_changes.h"

#include <zstd.h>

#include <span>
#include <string>

namespace osteomill {

namespace {

/// Some ten microseconds more than the fastest for a frame, and a tenth smaller.
constexpr int frame_compression_level = 3;

WireError changes_refused(const std::string& what) {
    return {"packed changes refused: " + what};
}

}  // namespace

ChangePacker::ChangePacker() : compressor_(frame_compression_level) {
    content_.reserve(largest_packed_changes_bytes);
}

v2::PackedChanges ChangePacker::pack(const Bone& bone, const std::vector<BrickChange>& changes) {
    v2::PackedChanges message;
    content_.clear();
    for (const auto& [brick, voxels, kind] : changes) {
        message.add_brick(brick);
        append(voxels, content_);
    }
    for (const auto& [brick, voxels, kind] : changes) {
        const auto fractions = bone.fractions(bone.slot(brick));
        voxels.for_each([&](std::size_t voxel) { content_.push_back(fractions[voxel]); });
    }
    const auto compressed = compressor_.compress(content_);
    message.set_zstd_masks_and_fractions(compressed.data(), compressed.size());
    return message;
}

std::optional<WireError> unpack(const v2::PackedChanges& message, ChangeKind kind,
                                const glm::ivec3& size_bricks, std::vector<ChangedBrick>& changes) {
    const auto count = static_cast<std::size_t>(message.brick_size());
    if (count == 0 || count * mask_bytes > largest_packed_changes_bytes)
        return changes_refused("they are of " + std::to_string(count) + " bricks, not 1 to " +
                               std::to_string(largest_packed_changes_bytes / mask_bytes));
    const std::string& packed = message.zstd_masks_and_fractions();
    std::vector<std::uint8_t> content(largest_packed_changes_bytes);
    const std::size_t size = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
    if (ZSTD_isError(size)) return changes_refused(ZSTD_getErrorName(size));
    if (size < count * mask_bytes) return changes_refused("they lack masks");
    content.resize(size);

    const glm::uvec3 table(size_bricks);
    changes.reserve(changes.size() + count);
    std::size_t next = count * mask_bytes;
    for (std::size_t i = 0; i < count; ++i) {
        const BrickIndex brick = message.brick(static_cast<int>(i));
        if (brick >= std::uint64_t{table.x} * table.y * table.z)
            return changes_refused("brick " + std::to_string(brick) + " lies outside the grid");
        ChangedBrick& changed = changes.emplace_back();
        changed.change = {brick, mask_at(std::span(content).subspan(i * mask_bytes)), kind};
        if (changed.change.voxels.count() > size - next) return changes_refused("they lack fractions");
        changed.change.voxels.for_each(
            [&](std::size_t voxel) { changed.fractions[voxel] = content[next++]; });
    }
    if (next != size) return changes_refused("they have more fractions than changed voxels");
    return std::nullopt;
}

}  // namespace osteomill
