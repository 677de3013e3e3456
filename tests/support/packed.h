// Packs any changes, even impossible ones, as a server packs those of its bone.
#pragma once

#include <vector>

#include "common/wire/packed_changes.h"

namespace osteomill::testing {

inline v2::PackedChanges packed(const std::vector<ChangedBrick>& changes) {
    v2::PackedChanges message;
    std::vector<std::uint8_t> content;
    for (const ChangedBrick& changed : changes) {
        message.add_brick(changed.change.brick);
        append(changed.change.voxels, content);
    }
    for (const ChangedBrick& changed : changes)
        changed.change.voxels.for_each(
            [&](std::size_t voxel) { content.push_back(changed.fractions[voxel]); });
    ZstdCompressor compressor(3);
    const auto compressed = compressor.compress(content);
    message.set_zstd_masks_and_fractions(compressed.data(), compressed.size());
    return message;
}

}  // namespace osteomill::testing
