#include "render_client/volume/textures/surface_texture.h"

#include <glm/common.hpp>

namespace osteomill {

SurfaceTexture::SurfaceTexture(const Bone& bone, const LookTable& table, const AtlasLayout& places)
    : shader_(table), texture_(gl::VoxelFormat::interpolated_rgba, places.texture_size()) {
    for (const PlacedVoxels& placed : places.all(bone.content())) shade(bone, placed);
}

void SurfaceTexture::update(const Bone& bone, AtlasLayout& places, std::span<const VoxelBox> changed) {
    for (const PlacedVoxels& placed : places.that_show(bone, changed, 1 + smoothing_reach_voxels))
        shade(bone, placed);
}

void SurfaceTexture::shade(const Bone& bone, const PlacedVoxels& placed) {
    const std::vector<SurfaceTexel>& texels = shader_.shade(bone, placed.voxels);
    // Four bytes without padding, as the texture takes them.
    static_assert(sizeof(SurfaceTexel) == 4);
    texture_.upload(placed.first_texel, placed.voxels.size,
                    {reinterpret_cast<const std::uint8_t*>(texels.data()), 4 * texels.size()});
}

}  // namespace osteomill
