#include "haptic_server/imaging/carved_bone.h"

#include <fmt/format.h>

#include <cstdlib>
#include <functional>

#include "common/bone/bone_builder.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::int16_t air_hu = -1000;
constexpr const char* checksum_key = "osteomill_bone_checksum";
constexpr const char* channels_key = "osteomill_channels";
constexpr const char* homogeneous_key = "osteomill_homogeneous_stiffness";
constexpr const char* per_code_key = "osteomill_stiffness_per_code";

std::filesystem::path channel_path(const std::filesystem::path& path, const char* channel) {
    std::filesystem::path result = path;
    result.replace_extension(fmt::format(".{}.nrrd", channel));
    return result;
}

/// Calls `visit(voxel, index in the dense grid, slot, offset in the brick)` for every voxel of every stored
/// brick.
template <typename Visit>
void for_each_stored_voxel(const Bone& bone, Visit&& visit) {
    const glm::ivec3 size = bone.grid().size_voxels;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 first =
            brick_position(bone.content().size_bricks, bone.content().brick_of_slot[slot]) *
            brick_edge_voxels;
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const auto o = static_cast<int>(offset);
            const glm::ivec3 voxel = first + glm::ivec3(o % 16, o / 16 % 16, o / 256);
            if (!contains(bone.grid(), voxel)) continue;
            const auto index =
                static_cast<std::size_t>(voxel.x) +
                static_cast<std::size_t>(size.x) *
                    (static_cast<std::size_t>(voxel.y) + static_cast<std::size_t>(size.y) * voxel.z);
            visit(index, slot, offset);
        }
    }
}

std::size_t voxel_count(const Grid& grid) {
    return static_cast<std::size_t>(grid.size_voxels.x) * grid.size_voxels.y * grid.size_voxels.z;
}

void write_channel(const std::filesystem::path& path, const char* channel, const Bone& bone,
                   const std::function<std::uint8_t(std::size_t slot, std::size_t offset)>& value) {
    std::vector<std::uint8_t> dense(voxel_count(bone.grid()), 0);
    for_each_stored_voxel(bone, [&](std::size_t index, std::size_t slot, std::size_t offset) {
        dense[index] = value(slot, offset);
    });
    write_byte_file(channel_path(path, channel), bone.grid(), dense, {});
}

double number_of_key(const std::filesystem::path& path, const HeaderKeys& keys, const char* key) {
    const auto found = keys.find(key);
    const double value = found == keys.end() ? 0.0 : std::strtod(found->second.c_str(), nullptr);
    if (!(value > 0.0 && value < 1e6))
        throw ImagingError(
            fmt::format("{}: header key {} is missing or no number above zero", path.string(), key));
    return value;
}

ByteBrick brick_of(const std::vector<std::uint8_t>& dense, const Grid& grid, const glm::ivec3& brick) {
    ByteBrick result{};
    const glm::ivec3 size = grid.size_voxels;
    for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
        const auto o = static_cast<int>(offset);
        const glm::ivec3 voxel = brick * brick_edge_voxels + glm::ivec3(o % 16, o / 16 % 16, o / 256);
        if (contains(grid, voxel))
            result[offset] =
                dense[static_cast<std::size_t>(voxel.x) +
                      static_cast<std::size_t>(size.x) *
                          (static_cast<std::size_t>(voxel.y) + static_cast<std::size_t>(size.y) * voxel.z)];
    }
    return result;
}

Bone bone_from_channels(const std::filesystem::path& path, const HuFile& file) {
    const Grid& grid = file.volume.grid;
    const std::string& channels = file.keys.at(channels_key);
    const bool heterogeneous = channels.find("stiffness") != std::string::npos;
    const bool labelled = channels.find("tissue") != std::string::npos;
    const std::vector<std::uint8_t> fraction = read_byte_file(channel_path(path, "fraction"), grid);
    std::vector<std::uint8_t> stiffness;
    std::vector<std::uint8_t> tissue;
    if (heterogeneous) stiffness = read_byte_file(channel_path(path, "stiffness"), grid);
    if (labelled) tissue = read_byte_file(channel_path(path, "tissue"), grid);

    BoneBuilder builder =
        heterogeneous
            ? BoneBuilder::heterogeneous(grid, number_of_key(path, file.keys, per_code_key), labelled)
            : BoneBuilder::homogeneous(grid, number_of_key(path, file.keys, homogeneous_key), labelled);
    const glm::ivec3 bricks = size_in_bricks(grid);
    for (int z = 0; z < bricks.z; ++z)
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x) {
                const glm::ivec3 brick(x, y, z);
                const ByteBrick codes = heterogeneous ? brick_of(stiffness, grid, brick) : ByteBrick{};
                const ByteBrick labels = labelled ? brick_of(tissue, grid, brick) : ByteBrick{};
                builder.add_brick(brick, brick_of(fraction, grid, brick), &codes, &labels);
            }
    Bone bone = std::move(builder).build();
    const auto stated = file.keys.find(checksum_key);
    if (stated == file.keys.end() || stated->second != fmt::format("{:016x}", checksum(bone)))
        throw ImagingError(fmt::format("{}: its fraction file {} belongs to another bone (checksums differ)",
                                       path.string(), channel_path(path, "fraction").filename().string()));
    return bone;
}

}  // namespace

void save_carved_bone(const std::filesystem::path& path, const HuVolume& source, double threshold_hu,
                      const Bone& bone) {
    if (path.extension() != ".nrrd")
        throw ImagingError(fmt::format("{}: the name must end in .nrrd", path.string()));
    if (source.grid.size_voxels != bone.grid().size_voxels)
        throw ImagingError(fmt::format("{}: the bone is of another size than its source", path.string()));
    HuVolume left{.grid = bone.grid(), .hu = source.hu, .tissue = {}};
    for_each_stored_voxel(bone, [&](std::size_t index, std::size_t slot, std::size_t offset) {
        const bool gone = bone.fractions(static_cast<std::int32_t>(slot))[offset] == 0;
        if (gone && left.hu[index] >= threshold_hu) left.hu[index] = air_hu;
    });

    const BoneContent& content = bone.content();
    std::string channels = "fraction";
    HeaderKeys keys{{threshold_key, fmt::format("{}", threshold_hu)},
                    {checksum_key, fmt::format("{:016x}", checksum(bone))}};
    write_channel(path, "fraction", bone, [&](std::size_t slot, std::size_t offset) {
        return bone.fractions(static_cast<std::int32_t>(slot))[offset];
    });
    if (content.stiffness.empty()) {
        keys[homogeneous_key] = fmt::format("{}", content.homogeneous_stiffness);
    } else {
        channels += " stiffness";
        keys[per_code_key] = fmt::format("{}", content.stiffness_per_code);
        write_channel(path, "stiffness", bone,
                      [&](std::size_t slot, std::size_t offset) { return content.stiffness[slot][offset]; });
    }
    if (!content.tissue.empty()) {
        channels += " tissue";
        write_channel(path, "tissue", bone,
                      [&](std::size_t slot, std::size_t offset) { return content.tissue[slot][offset]; });
    }
    keys[channels_key] = channels;
    write_hu_file(path, left, keys);
}

Bone bone_from_file(const std::filesystem::path& path, const HuFile& file, double threshold_hu,
                    const StiffnessRelation& relation) {
    if (file.keys.contains(channels_key)) return bone_from_channels(path, file);
    return bone_from_hu(file.volume, threshold_hu, relation);
}

}  // namespace osteomill
