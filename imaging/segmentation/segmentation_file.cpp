#include "imaging/segmentation/segmentation_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <set>
#include <span>
#include <stdexcept>

#include "imaging/bone_file/digest.h"
#include "imaging/bone_file/nrrd_writer.h"

namespace osteomill {

namespace {

bool overlap(const StructureMask& one, const StructureMask& other) {
    auto a = one.bricks().begin();
    auto b = other.bricks().begin();
    while (a != one.bricks().end() && b != other.bricks().end()) {
        if (a->brick == b->brick && a->voxels.without(b->voxels) != a->voxels) return true;
        if (a->brick <= b->brick)
            ++a;
        else
            ++b;
    }
    return false;
}

/// The first layer each fits into beside those before it.
std::vector<int> layers_of(const std::vector<NamedStructure>& structures) {
    std::vector<int> layers;
    for (std::size_t i = 0; i < structures.size(); ++i) {
        std::set<int> taken;
        for (std::size_t before = 0; before < i; ++before)
            if (overlap(structures[before].mask, structures[i].mask)) taken.insert(layers[before]);
        int layer = 0;
        while (taken.contains(layer)) ++layer;
        layers.push_back(layer);
    }
    return layers;
}

VoxelBounds box_of(const std::vector<NamedStructure>& structures) {
    VoxelBounds box = *structures.front().mask.bounds();
    for (const NamedStructure& one : structures) {
        const VoxelBounds bounds = *one.mask.bounds();
        box = {glm::min(box.first, bounds.first), glm::max(box.last, bounds.last)};
    }
    return box;
}

std::map<std::string, std::string> keys_of(const std::vector<NamedStructure>& structures,
                                           const std::vector<int>& layers, const glm::ivec3& size) {
    std::map<std::string, std::string> keys{{file_digest_key, no_digest_yet()}};
    for (std::size_t i = 0; i < structures.size(); ++i) {
        const auto set = [&](const char* what, const std::string& value) {
            keys[fmt::format("Segment{}_{}", i, what)] = value;
        };
        const auto& [red, green, blue] = structures[i].colour_rgb;
        set("ID", fmt::format("Segment_{}", i + 1));
        set("Name", structures[i].name);
        set("Color", fmt::format("{:.6f} {:.6f} {:.6f}", red / 255.0, green / 255.0, blue / 255.0));
        set("Layer", std::to_string(layers[i]));
        set("LabelValue", std::to_string(i + 1));
        set("Extent", fmt::format("0 {} 0 {} 0 {}", size.x - 1, size.y - 1, size.z - 1));
    }
    return keys;
}

}  // namespace

void write_segmentation(const std::filesystem::path& path, const std::vector<NamedStructure>& structures) {
    if (structures.empty() || structures.size() > 255)
        throw std::invalid_argument("a segmentation has 1 to 255 structures");
    for (const NamedStructure& one : structures)
        if (one.mask.empty()) throw std::invalid_argument("a structure of a segmentation has voxels");
    const Grid& bone = structures.front().mask.grid();
    const VoxelBounds box = box_of(structures);
    const glm::ivec3 size = box.last - box.first + 1;
    const std::vector<int> layers = layers_of(structures);
    NrrdForm form{.voxel = NrrdVoxel::uint8,
                  .grid = {.size_voxels = size,
                           .spacing_mm = bone.spacing_mm,
                           .origin_mm = centre_of_voxel_mm(bone, box.first)},
                  .layers = 1 + *std::ranges::max_element(layers),
                  .key_values = keys_of(structures, layers, size)};
    NrrdWriter writer(path, form);
    const auto all_layers = static_cast<std::size_t>(form.layers);
    std::vector<std::uint8_t> slice(voxels_of_slice(form.grid) * all_layers);
    const glm::ivec3 bricks = size_in_bricks(bone);
    for (int z = box.first.z; z <= box.last.z; ++z) {
        std::ranges::fill(slice, std::uint8_t{0});
        for (std::size_t i = 0; i < structures.size(); ++i) {
            const auto& all = structures[i].mask.bricks();
            const auto first = std::ranges::lower_bound(
                all, brick_index(bricks, {0, 0, z / brick_edge_voxels}), {}, &StructureBrick::brick);
            for (auto brick = first; brick != all.end(); ++brick) {
                const glm::ivec3 corner = brick_edge_voxels * brick_position(bricks, brick->brick);
                if (corner.z > z) break;
                brick->voxels.for_each([&](std::size_t offset) {
                    const glm::ivec3 voxel = corner + voxel_in_brick(offset) - box.first;
                    if (voxel.z != z - box.first.z) return;
                    const auto place = static_cast<std::size_t>(voxel.x) +
                                       static_cast<std::size_t>(size.x) * static_cast<std::size_t>(voxel.y);
                    slice[place * all_layers + static_cast<std::size_t>(layers[i])] =
                        static_cast<std::uint8_t>(i + 1);
                });
            }
        }
        writer.add(std::as_bytes(std::span(slice)));
    }
    writer.commit(form.key_values);
}

}  // namespace osteomill
