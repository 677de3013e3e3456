#include "imaging/bone_file/removed_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/text/append.h"
#include "imaging/bone_file/nrrd_writer.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

std::uint8_t lost(std::uint8_t before, std::uint8_t after) {
    return static_cast<std::uint8_t>(before > after ? before - after : 0);
}

/// The fraction of a voxel in a brick; 0 if the bone has no such brick.
std::uint8_t fraction_in(const Bone& bone, std::int32_t slot, std::size_t offset) {
    return slot == BoneContent::no_slot ? std::uint8_t{0} : bone.fractions(slot)[offset];
}

/// Puts the part of a brick that lies within the grid into the layer of slices that it belongs to.
void put_brick(const Bone& before, std::size_t slot, const Bone& after, std::span<std::uint8_t> layer) {
    const Grid& grid = before.grid();
    const BrickIndex brick = before.content().brick_of_slot[slot];
    const std::int32_t slot_after = after.slot(brick);
    const auto fractions = before.fractions(static_cast<std::int32_t>(slot));
    const glm::ivec3 corner = brick_position(before.content().size_bricks, brick) * brick_edge_voxels;
    const auto row = static_cast<std::size_t>(grid.size_voxels.x);
    const std::size_t slice = row * static_cast<std::size_t>(grid.size_voxels.y);
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        if (fractions[offset] == 0) continue;
        const glm::ivec3 within = voxel_in_brick(offset);
        const glm::ivec3 voxel = corner + within;
        layer[static_cast<std::size_t>(voxel.x) + row * static_cast<std::size_t>(voxel.y) +
              slice * static_cast<std::size_t>(within.z)] =
            lost(fractions[offset], fraction_in(after, slot_after, offset));
    }
}

}  // namespace

std::optional<glm::ivec3> first_risen_voxel(const Bone& before, const Bone& after) {
    const BoneContent& content = after.content();
    for (std::size_t slot = 0; slot < after.stored_bricks(); ++slot) {
        const BrickIndex brick = content.brick_of_slot[slot];
        const std::int32_t slot_before = before.slot(brick);
        const auto fractions = after.fractions(static_cast<std::int32_t>(slot));
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
            if (fractions[offset] > fraction_in(before, slot_before, offset))
                return brick_position(content.size_bricks, brick) * brick_edge_voxels +
                       voxel_in_brick(offset);
    }
    return std::nullopt;
}

void save_removed(const std::filesystem::path& path, const Bone& before, const Bone& after) {
    if (before.grid() != after.grid())
        throw std::invalid_argument("what is left of a bone does not lie on the grid of what it was");
    const Grid& grid = before.grid();
    NrrdWriter writer(path, {.voxel = NrrdVoxel::uint8, .grid = grid});
    const auto slice = static_cast<std::size_t>(voxels_of_slice(grid));
    std::vector<std::uint8_t> layer(
        slice * static_cast<std::size_t>(std::min(grid.size_voxels.z, brick_edge_voxels)));
    const BoneContent& content = before.content();
    std::size_t slot = 0;  // bricks ascend, z last
    for (int z = 0; z < grid.size_voxels.z; z += brick_edge_voxels) {
        std::fill(layer.begin(), layer.end(), std::uint8_t{0});
        for (; slot < before.stored_bricks() &&
               brick_position(content.size_bricks, content.brick_of_slot[slot]).z == z / brick_edge_voxels;
             ++slot)
            put_brick(before, slot, after, layer);
        const int slices = std::min(grid.size_voxels.z - z, brick_edge_voxels);
        writer.add(std::as_bytes(std::span(layer).first(slice * static_cast<std::size_t>(slices))));
    }
    writer.commit({});
}

std::string text_of_removed(const VolumesByTissue& removed_mm3) {
    // Differences of large sums leave rounding, which is no bone.
    constexpr double least_mm3 = 1e-9;
    std::string text;
    for (std::size_t label = 0; label < removed_mm3.size(); ++label)
        if (removed_mm3[label] > least_mm3)
            append_formatted(text, "{}{}:{:.9f}", text.empty() ? "" : " ", label, removed_mm3[label]);
    return text;
}

VolumesByTissue removed_before_mm3(const BoneFile& file) {
    VolumesByTissue removed_mm3{};
    const auto found = file.key_values().find(removed_key);
    if (found == file.key_values().end()) return removed_mm3;
    std::istringstream text(found->second);
    while (!(text >> std::ws).eof()) {
        std::size_t label = 0;
        char colon = ' ';
        double mm3 = 0.0;
        text >> label >> colon >> mm3;
        if (text.fail() || colon != ':' || label >= removed_mm3.size() || !std::isfinite(mm3) || mm3 < 0.0)
            throw ImagingError(file.path(), fmt::format("damaged: {}:={} is no list of LABEL:MM3",
                                                        removed_key, found->second));
        removed_mm3[label] = mm3;
    }
    return removed_mm3;
}

}  // namespace osteomill
