#include "render_client/volume/textures/surface_texture.h"

#include <glm/common.hpp>

namespace osteomill {

SurfaceTexture::SurfaceTexture(const Bone& bone, const TransferTable& table, const AtlasLayout& places)
    : SurfaceTexture(table, gl::Texture3D(gl::VoxelFormat::interpolated_rgba, places.texture_size())) {
    finish(fill(bone, places));
}

Steps SurfaceTexture::fill(const Bone& bone, const AtlasLayout& places) {
    const std::vector<PlacedVoxels> all = places.all(bone.content());
    for (std::size_t region = 0; region < all.size(); ++region) {
        shade(bone, all[region]);
        co_yield static_cast<double>(region) / static_cast<double>(all.size());
    }
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
