#include "haptic_server/imaging/carved_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "common/bone/bone_builder.h"
#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/nrrd_volume.h"

namespace osteomill {

namespace {

constexpr const char* fraction_key = "osteomill_fraction_file";
constexpr const char* stiffness_key = "osteomill_stiffness_file";
constexpr const char* tissue_key = "osteomill_tissue_file";
constexpr const char* checksum_key = "osteomill_bone_checksum";
constexpr const char* stiffness_per_code_key = "osteomill_stiffness_per_code";
constexpr const char* homogeneous_stiffness_key = "osteomill_homogeneous_stiffness";

using KeyValues = std::map<std::string, std::string>;
using Bytes = std::vector<std::uint8_t>;

std::filesystem::path companion(const std::filesystem::path& path, const char* channel) {
    std::filesystem::path name = path;
    return name.replace_extension(fmt::format(".{}.nrrd", channel));
}

std::string checksum_text(const Bone& bone) {
    return fmt::format("{:016x}", checksum(bone));
}

/// Calls visit(offset in the dense volume, offset in the brick) for the voxels of a brick that lie in the
/// grid.
template <typename Visit>
void for_voxels_of_brick(const Grid& grid, const glm::ivec3& brick, const Visit& visit) {
    const glm::ivec3 first = brick * brick_edge_voxels;
    const auto nx = static_cast<std::size_t>(grid.size_voxels.x);
    const auto ny = static_cast<std::size_t>(grid.size_voxels.y);
    for (int z = first.z; z < std::min(first.z + brick_edge_voxels, grid.size_voxels.z); ++z)
        for (int y = first.y; y < std::min(first.y + brick_edge_voxels, grid.size_voxels.y); ++y)
            for (int x = first.x; x < std::min(first.x + brick_edge_voxels, grid.size_voxels.x); ++x)
                visit(static_cast<std::size_t>(x) +
                          nx * (static_cast<std::size_t>(y) + ny * static_cast<std::size_t>(z)),
                      offset_in_brick({x, y, z}));
}

/// A channel as a dense volume; 0 where no brick is stored.
template <typename BrickOfSlot>
Bytes dense(const Bone& bone, const BrickOfSlot& brick_of_slot) {
    const glm::ivec3 size = bone.grid().size_voxels;
    Bytes voxels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                 static_cast<std::size_t>(size.z));
    const BoneContent& content = bone.content();
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto& bytes = brick_of_slot(slot);
        for_voxels_of_brick(bone.grid(), brick_position(content.size_bricks, content.brick_of_slot[slot]),
                            [&](std::size_t voxel, std::size_t offset) { voxels[voxel] = bytes[offset]; });
    }
    return voxels;
}

const std::string& value_of(const std::filesystem::path& path, const KeyValues& key_values, const char* key) {
    const auto found = key_values.find(key);
    if (found == key_values.end())
        throw ImagingError(path, fmt::format("key {} is missing, which a carved bone must have", key));
    return found->second;
}

double number_of(const std::filesystem::path& path, const KeyValues& key_values, const char* key) {
    const std::string& text = value_of(path, key_values, key);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(number > 0.0))
        throw ImagingError(path, fmt::format("{}:={} is not a number above 0", key, text));
    return number;
}

/// A companion file that `key` names; empty where the key is absent.
Bytes channel_of(const std::filesystem::path& path, const BoneFile& file, const char* key) {
    const auto found = file.key_values.find(key);
    if (found == file.key_values.end()) return {};
    const std::filesystem::path beside = path.parent_path() / found->second;
    if (!std::filesystem::exists(beside))
        throw ImagingError(path,
                           fmt::format("the carved bone's file {} is missing beside it", found->second));
    NrrdVolume<std::uint8_t> channel = read_nrrd_volume<std::uint8_t>(beside);
    if (channel.grid != file.volume.grid)
        throw ImagingError(beside,
                           fmt::format("its grid is not that of {}, to which it belongs", path.string()));
    return std::move(channel.voxels);
}

ByteBrick brick_of(const Grid& grid, const glm::ivec3& brick, const Bytes& voxels) {
    ByteBrick bytes{};
    if (!voxels.empty())
        for_voxels_of_brick(grid, brick,
                            [&](std::size_t voxel, std::size_t offset) { bytes[offset] = voxels[voxel]; });
    return bytes;
}

}  // namespace

void save_carved_bone(const std::filesystem::path& path, const HuVolume& source, const Bone& bone,
                      const KeyValues& source_key_values) {
    if (source.grid != bone.grid())
        throw std::invalid_argument(
            "the carved bone does not lie on the grid of the volume it was built from");
    const BoneContent& content = bone.content();
    KeyValues key_values = source_key_values;
    key_values[checksum_key] = checksum_text(bone);
    key_values[fraction_key] = companion(path, "fraction").filename().string();

    // Only bone can have been milled away: air and soft tissue have no fraction to lose, and what is stored
    // with fraction 0 outside bone is told from it by the stiffness code that only bone has.
    HuVolume carved{.grid = source.grid, .hu = source.hu, .tissue = {}};
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto left = bone.fractions(static_cast<std::int32_t>(slot));
        for_voxels_of_brick(bone.grid(), brick_position(content.size_bricks, content.brick_of_slot[slot]),
                            [&](std::size_t voxel, std::size_t offset) {
                                const bool was_bone =
                                    content.stiffness.empty() || content.stiffness[slot][offset] != 0;
                                if (left[offset] == 0 && was_bone) carved.hu[voxel] = milled_away_hu;
                            });
    }

    write_nrrd_volume(
        companion(path, "fraction"), bone.grid(),
        dense(bone, [&](std::size_t slot) { return bone.fractions(static_cast<std::int32_t>(slot)); }), {});
    if (content.stiffness.empty()) {
        key_values[homogeneous_stiffness_key] = fmt::format("{}", content.homogeneous_stiffness);
    } else {
        key_values[stiffness_key] = companion(path, "stiffness").filename().string();
        key_values[stiffness_per_code_key] = fmt::format("{}", content.stiffness_per_code);
        write_nrrd_volume(companion(path, "stiffness"), bone.grid(),
                          dense(bone, [&](std::size_t slot) { return content.stiffness[slot]; }), {});
    }
    if (!content.tissue.empty()) {
        key_values[tissue_key] = companion(path, "tissue").filename().string();
        write_nrrd_volume(companion(path, "tissue"), bone.grid(),
                          dense(bone, [&](std::size_t slot) { return content.tissue[slot]; }), {});
    }
    // Last, so that a file of this name always has its companions.
    write_hu_nrrd(path, carved, key_values);
}

bool is_carved(const BoneFile& file) {
    return file.key_values.contains(fraction_key);
}

Bone restore_carved_bone(const std::filesystem::path& path, const BoneFile& file) {
    const Grid& grid = file.volume.grid;
    value_of(path, file.key_values, fraction_key);
    const std::string& expected = value_of(path, file.key_values, checksum_key);
    const Bytes fraction = channel_of(path, file, fraction_key);
    const Bytes stiffness = channel_of(path, file, stiffness_key);
    const Bytes tissue = channel_of(path, file, tissue_key);

    BoneBuilder builder =
        stiffness.empty()
            ? BoneBuilder::homogeneous(grid, number_of(path, file.key_values, homogeneous_stiffness_key),
                                       !tissue.empty())
            : BoneBuilder::heterogeneous(grid, number_of(path, file.key_values, stiffness_per_code_key),
                                         !tissue.empty());
    const glm::ivec3 size_bricks = size_in_bricks(grid);
    for (int z = 0; z < size_bricks.z; ++z)
        for (int y = 0; y < size_bricks.y; ++y)
            for (int x = 0; x < size_bricks.x; ++x) {
                const ByteBrick codes = brick_of(grid, {x, y, z}, stiffness);
                const ByteBrick labels = brick_of(grid, {x, y, z}, tissue);
                builder.add_brick({x, y, z}, brick_of(grid, {x, y, z}, fraction), &codes, &labels);
            }
    Bone bone = std::move(builder).build();
    if (checksum_text(bone) != expected)
        throw ImagingError(
            path, fmt::format("its fractions have checksum {}, not the {} that was saved: {} is "
                              "of another carving",
                              checksum_text(bone), expected, file.key_values.find(fraction_key)->second));
    return bone;
}

}  // namespace osteomill
