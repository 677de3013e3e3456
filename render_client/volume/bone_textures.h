// The bone as 3D textures: its fractions, which are carved, without what its look hides; one byte a voxel of
// what colours it (tissue label or stiffness code), only where the bone has such a channel; the colours of
// its surface voxels, only where the look asks for them; and the maps for skipping empty space.
#pragma once

#include <optional>
#include <span>

#include "common/bone/bone.h"
#include "render_client/volume/bone_look.h"
#include "render_client/volume/empty_space.h"
#include "render_client/volume/gl/lookup_table.h"
#include "render_client/volume/gl/texture3d.h"
#include "render_client/volume/surface_texture.h"
#include "render_client/volume/visible_bone.h"

namespace osteomill {

class BoneTextures {
  public:
    /// Uploads all of it, cropped to the stored bricks. Another look takes other textures. Throws
    /// std::runtime_error naming sizes where the bone exceeds the driver's 3D textures or has no brick, and
    /// std::invalid_argument where the look's transfer function is none.
    BoneTextures(const Bone& bone, std::span<const TissueColour> tissues, const BoneLook& look = {});

    /// Uploads the fractions of these bricks and what follows from them: glTexSubImage3D, brick by brick.
    /// `bone` is the bone of the constructor, carved since. Call before drawing: a texture that a frame in
    /// flight uses makes the call wait for that frame.
    void update(const Bone& bone, std::span<const BrickIndex> dirty);

    /// The part of the bone's grid that the textures hold, in whole bricks.
    const VoxelBox& box() const { return box_; }
    const Grid& grid() const { return grid_; }
    const gl::Texture3D& fraction() const { return fraction_; }
    const gl::Texture3D& distance() const { return distance_; }
    const gl::Texture3D& mean_fraction() const { return mean_fraction_; }
    /// What `colours` is looked up by; none for a homogeneous, unlabelled bone.
    const std::optional<gl::Texture3D>& colour_code() const { return colour_code_; }
    const gl::LookupTable& colours() const { return colours_; }
    /// Display RGB times alpha, and alpha, of the surface voxels; none unless the look shades them.
    const gl::Texture3D* surface_colours() const { return surface_ ? &surface_->texture() : nullptr; }
    /// Whether one sees through the bone: opacities are then per millimetre.
    bool is_translucent() const { return table_.mode == TransferMode::translucent; }

    /// A point of patient space in texture coordinates counted in voxels: (0, 0, 0) is the box's corner.
    glm::dvec3 to_box_voxels(const glm::dvec3& position_mm) const;

  private:
    const Bone& shown(const Bone& bone) const { return visible_ ? visible_->bone() : bone; }

    Grid grid_;
    VoxelBox box_;
    LookTable table_;
    std::optional<VisibleBone> visible_;  ///< only where the look hides bone
    EmptySpace empty_space_;
    gl::Texture3D fraction_;
    gl::Texture3D distance_;
    gl::Texture3D mean_fraction_;
    std::optional<gl::Texture3D> colour_code_;
    gl::LookupTable colours_;
    std::optional<SurfaceTexture> surface_;
};

}  // namespace osteomill
