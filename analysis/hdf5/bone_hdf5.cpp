#include "analysis/hdf5/bone_hdf5.h"

#include <cerrno>
#include <glm/common.hpp>

namespace osteomill {

namespace {

using Sizes = std::array<hsize_t, 3>;

Sizes sizes(const glm::ivec3& of) {
    return {static_cast<hsize_t>(of.x), static_cast<hsize_t>(of.y), static_cast<hsize_t>(of.z)};
}

/// `brick_of`: the bytes of a stored brick.
template <typename BrickOf>
void write_channel(Hdf5File& file, const std::string& path, const Bone& bone, const BrickOf& brick_of) {
    errno = 0;
    const glm::ivec3 size = bone.grid().size_voxels;
    const Sizes all = sizes(size);
    const Sizes chunk = sizes(glm::min(size, glm::ivec3(brick_edge_voxels)));
    const Hdf5Id in_file(file.check(H5Screate_simple(3, all.data(), nullptr)), H5Sclose);
    const Hdf5Id properties = file.dataset_properties();
    file.check(H5Pset_chunk(properties.get(), 3, chunk.data()));
    file.check(H5Pset_deflate(properties.get(), gzip_level));
    const Hdf5Id dataset(file.check(H5Dcreate2(file.id(), path.c_str(), H5T_STD_U8LE, in_file.get(),
                                               file.link_properties(), properties.get(), H5P_DEFAULT)),
                         H5Dclose);
    ByteBrick turned;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks,
                                                                    bone.content().brick_of_slot[slot]);
        const glm::ivec3 here = glm::min(size - first, glm::ivec3(brick_edge_voxels));
        const auto& brick = brick_of(static_cast<std::int32_t>(slot));
        std::size_t next = 0;
        for (int i = 0; i < here.x; ++i)
            for (int j = 0; j < here.y; ++j)
                for (int k = 0; k < here.z; ++k) turned[next++] = brick[offset_in_brick({i, j, k})];
        const Sizes start = sizes(first);
        const Sizes count = sizes(here);
        const Hdf5Id in_memory(file.check(H5Screate_simple(3, count.data(), nullptr)), H5Sclose);
        file.check(
            H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
        file.check(H5Dwrite(dataset.get(), H5T_NATIVE_UINT8, in_memory.get(), in_file.get(), H5P_DEFAULT,
                            turned.data()));
    }
}

}  // namespace

void write_bone(Hdf5File& file, const std::string& group, const Bone& bone) {
    const BoneContent& content = bone.content();
    write_channel(file, group + "/fraction", bone, [&](std::int32_t slot) { return bone.fractions(slot); });
    if (!content.stiffness.empty())
        write_channel(file, group + "/stiffness", bone, [&](std::int32_t slot) -> const ByteBrick& {
            return content.stiffness[static_cast<std::size_t>(slot)];
        });
    if (!content.tissue.empty())
        write_channel(file, group + "/tissue", bone,
                      [&](std::int32_t slot) -> const ByteBrick& { return *content.tissues_of(slot); });
    const glm::dvec3& origin_mm = bone.grid().origin_mm;
    file.set_attribute(group, "spacing_mm", bone.grid().spacing_mm);
    file.set_attribute(group, "origin_mm", std::array{origin_mm.x, origin_mm.y, origin_mm.z});
    file.set_attribute(group, "relative_stiffness_per_code", content.stiffness_per_code);
    file.set_attribute(group, "homogeneous_relative_stiffness", content.homogeneous_stiffness);
}

}  // namespace osteomill
