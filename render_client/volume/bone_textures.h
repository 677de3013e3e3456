// The bone as 3D textures: its fractions, which are carved; one byte a voxel of what colours it (tissue label
// or stiffness code), only where the bone has such a channel; and the maps for skipping empty space.
#pragma once

#include <optional>
#include <span>

#include "common/bone/bone.h"
#include "render_client/volume/bone_colours.h"
#include "render_client/volume/empty_space.h"
#include "render_client/volume/gl/lookup_table.h"
#include "render_client/volume/gl/texture3d.h"

namespace osteomill {

class BoneTextures {
  public:
    /// Uploads all of it, cropped to the stored bricks. Tissue colours are used where the bone is labelled.
    /// Throws std::runtime_error naming sizes where the bone exceeds the driver's 3D textures or has no
    /// brick.
    BoneTextures(const Bone& bone, std::span<const TissueColour> tissues);

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

    /// A point of patient space in texture coordinates counted in voxels: (0, 0, 0) is the box's corner.
    glm::dvec3 to_box_voxels(const glm::dvec3& position_mm) const;

  private:
    Grid grid_;
    VoxelBox box_;
    EmptySpace empty_space_;
    gl::Texture3D fraction_;
    gl::Texture3D distance_;
    gl::Texture3D mean_fraction_;
    std::optional<gl::Texture3D> colour_code_;
    gl::LookupTable colours_;
};

}  // namespace osteomill
