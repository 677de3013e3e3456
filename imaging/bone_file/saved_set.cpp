#include "imaging/bone_file/saved_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>
#include <optional>
#include <span>
#include <utility>

#include "common/bone/bone_builder.h"
#include "common/files/inside_folder.h"
#include "common/scene/stiffness_relation.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr const char* fraction_key = "osteomill_fraction_file";
constexpr const char* stiffness_key = "osteomill_stiffness_file";
constexpr const char* tissue_key = "osteomill_tissue_file";

struct ChannelName {
    const char* key;
    const char* suffix;
};
constexpr ChannelName channel_names[] = {
    {fraction_key, "fraction"}, {stiffness_key, "stiffness"}, {tissue_key, "tissue"}};

std::filesystem::path companion(const std::filesystem::path& path, const char* suffix) {
    std::filesystem::path name = path;
    return name.replace_extension(fmt::format(".{}.nrrd", suffix));
}

/// A dense channel, a layer of bricks at a time.
class ChannelLayers {
  public:
    ChannelLayers(const BoneFile& file, const std::string& name)
        : beside_(existing(file, name), NrrdVoxel::uint8), data_(beside_.data()) {
        const Grid& grid = beside_.form().grid;
        if (grid != file.grid())
            throw ImagingError(beside_.path(), fmt::format("its grid is not that of {}, to which it belongs",
                                                           file.path().string()));
        data_.skip(beside_.form().bytes_before_voxels);
        slice_ = static_cast<std::size_t>(voxels_of_slice(grid));
        layer_.resize(slice_ * static_cast<std::size_t>(std::min(grid.size_voxels.z, brick_edge_voxels)));
    }

    void read_layer(int layer) {
        first_z_ = layer * brick_edge_voxels;
        const int left = beside_.form().grid.size_voxels.z - first_z_;
        const auto slices = static_cast<std::size_t>(std::min(left, brick_edge_voxels));
        data_.read_voxels(std::span(layer_).first(slice_ * slices));
        if (left <= brick_edge_voxels) data_.finish();
    }

    ByteBrick brick(const glm::ivec3& brick) const {
        ByteBrick bytes{};
        const Grid& grid = beside_.form().grid;
        const glm::ivec3 first = brick * brick_edge_voxels;
        const glm::ivec3 end = glm::min(first + brick_edge_voxels, grid.size_voxels);
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y)
                std::copy_n(layer_.begin() +
                                static_cast<std::ptrdiff_t>(slice_ * static_cast<std::size_t>(z - first_z_) +
                                                            static_cast<std::size_t>(grid.size_voxels.x) *
                                                                static_cast<std::size_t>(y) +
                                                            static_cast<std::size_t>(first.x)),
                            end.x - first.x,
                            bytes.begin() + static_cast<std::ptrdiff_t>(offset_in_brick({0, y, z})));
        return bytes;
    }

  private:
    static std::filesystem::path existing(const BoneFile& file, const std::string& name) {
        const std::filesystem::path plain(name);
        if (plain.has_parent_path() || plain.is_absolute())
            throw ImagingError(file.path(), fmt::format("names {}, which is no file beside it", name));
        const std::filesystem::path beside = file.path().parent_path() / plain;
        if (!std::filesystem::exists(beside))
            throw ImagingError(file.path(),
                               fmt::format("the carved bone's file {} is missing beside it", name));
        if (!lies_inside(beside, file.path().parent_path()))
            throw ImagingError(file.path(),
                               fmt::format("names {}, a link that leads out of its folder", name));
        return beside;
    }

    NrrdFile beside_;
    NrrdData data_;
    std::size_t slice_ = 0;
    int first_z_ = 0;
    std::vector<std::uint8_t> layer_{};
};

std::optional<ChannelLayers> channel_of(const BoneFile& file, const char* key) {
    const auto found = file.key_values().find(key);
    if (found == file.key_values().end()) return std::nullopt;
    return std::optional<ChannelLayers>(std::in_place, file, found->second);
}

}  // namespace

std::string bone_checksum_text(const Bone& bone) {
    return fmt::format("{:016x}", checksum(bone));
}

void require_bone_checksum(const BoneFile& file, const Bone& bone) {
    const std::string& expected = file.value(bone_checksum_key);
    if (bone_checksum_text(bone) != expected)
        throw ImagingError(file.path(),
                           fmt::format("its fractions have checksum {}, not the {} that was saved: they are "
                                       "of another carving",
                                       bone_checksum_text(bone), expected));
}

double number_of_key(const BoneFile& file, const char* key) {
    const std::string& text = file.value(key);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(number > 0.0) || number > largest_relative_stiffness)
        throw ImagingError(file.path(), fmt::format("{}:={} is not a number above 0, at most {:g}", key, text,
                                                    largest_relative_stiffness));
    return number;
}

bool is_saved_set(const BoneFile& file) {
    return file.key_values().contains(fraction_key);
}

RestoredBone restore_saved_set(const BoneFile& file) {
    file.value(bone_checksum_key);
    ChannelLayers fraction = *channel_of(file, fraction_key);
    std::optional<ChannelLayers> stiffness = channel_of(file, stiffness_key);
    std::optional<ChannelLayers> tissue = channel_of(file, tissue_key);
    BoneBuilder builder =
        stiffness ? BoneBuilder::heterogeneous(file.grid(), number_of_key(file, stiffness_per_code_key),
                                               tissue.has_value())
                  : BoneBuilder::homogeneous(file.grid(), number_of_key(file, homogeneous_stiffness_key),
                                             tissue.has_value());
    const glm::ivec3 size_bricks = size_in_bricks(file.grid());
    for (int z = 0; z < size_bricks.z; ++z) {
        fraction.read_layer(z);
        if (stiffness) stiffness->read_layer(z);
        if (tissue) tissue->read_layer(z);
        for (int y = 0; y < size_bricks.y; ++y)
            for (int x = 0; x < size_bricks.x; ++x) {
                const glm::ivec3 brick(x, y, z);
                const ByteBrick codes = stiffness ? stiffness->brick(brick) : ByteBrick{};
                const ByteBrick labels = tissue ? tissue->brick(brick) : ByteBrick{};
                builder.add_brick(brick, fraction.brick(brick), &codes, &labels);
            }
    }
    HuReader hu(file);
    hu.read_to_end();
    Bone bone = std::move(builder).build();
    require_bone_checksum(file, bone);
    return {std::move(bone), hu.digest()};
}

std::vector<std::filesystem::path> files_of_saved_set(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files;
    try {
        if (!std::filesystem::exists(path)) return {};
        const BoneFile file(path);
        for (const ChannelName& channel : channel_names) {
            const auto named = file.key_values().find(channel.key);
            const std::filesystem::path own = companion(path, channel.suffix);
            if (named != file.key_values().end() && named->second == own.filename().string())
                files.push_back(own);
        }
    } catch (const std::exception&) {
        return {};  // something else has that name, and will be replaced
    }
    return files;
}

}  // namespace osteomill
