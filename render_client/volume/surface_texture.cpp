#include "render_client/volume/surface_texture.h"

#include <glm/common.hpp>

namespace osteomill {

SurfaceTexture::SurfaceTexture(const Bone& bone, const LookTable& table, const VoxelBox& box)
    : table_(table), box_(box), texture_(gl::VoxelFormat::interpolated_rgba, box.size) {
    // In layers one brick high, so that no dense copy of the whole bone is made.
    for (int z = 0; z < box.size.z; z += brick_edge_voxels)
        shade(bone, {box.first + glm::ivec3(0, 0, z), {box.size.x, box.size.y, brick_edge_voxels}});
}

void SurfaceTexture::update(const Bone& bone, std::span<const BrickIndex> dirty) {
    for (const BrickIndex index : dirty) {
        const glm::ivec3 first = brick_position(bone.content().size_bricks, index) * brick_edge_voxels - 1;
        const glm::ivec3 low = glm::max(first, box_.first);
        const glm::ivec3 high = glm::min(first + brick_edge_voxels + 2, box_.first + box_.size);
        const VoxelBox changed{low, glm::max(high - low, 0)};
        if (changed.count() > 0) shade(bone, changed);
    }
}

void SurfaceTexture::shade(const Bone& bone, const VoxelBox& box) {
    const std::vector<SurfaceTexel> texels = shade_surface_voxels(bone, table_, box);
    // Four bytes without padding, as the texture takes them.
    static_assert(sizeof(SurfaceTexel) == 4);
    texture_.upload(box.first - box_.first, box.size,
                    {reinterpret_cast<const std::uint8_t*>(texels.data()), 4 * texels.size()});
}

}  // namespace osteomill
