// The bone as 3D textures: its fractions, which are carved, without the voxels that its appearance hides; one
// byte a voxel for its colour (tissue label or stiffness code), only if the bone has such a channel; the
// colours of its surface voxels, only if the appearance needs them; the smoothed fractions, for normals; and
// a map for skipping empty space and for ambient light. Dense, as a brick atlas, or of a coarser copy, as
// memory allows.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/volume/gl/storage_thread.h"
#include "render_client/volume/gl/texture.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/coarse_bone.h"
#include "render_client/volume/textures/empty_space.h"
#include "render_client/volume/textures/sawn_faces.h"
#include "render_client/volume/textures/seen_through.h"
#include "render_client/volume/textures/smoothed_fraction.h"
#include "render_client/volume/textures/surface_voxels.h"
#include "render_client/volume/textures/texture_plan.h"
#include "render_client/volume/textures/visible_bone.h"
#include "render_client/volume/textures/voxel_box.h"

namespace osteomill {

class BoneTextures {
  public:
    /// Uploads all of it at once (TextureBuild does so in steps), cropped to the stored bricks, by the first
    /// of texture_plans for which the driver has memory. Other shading settings need other textures. Throws
    /// std::runtime_error if the bone has no brick and, naming sizes, if nothing fits; std::invalid_argument
    /// for an invalid transfer function.
    BoneTextures(const Bone& bone, std::span<const TissueColour> tissues, const ShadingSettings& look = {},
                 const TextureLimits& limits = {});

    /// Uploads lowered and raised voxels, and all texels that depend on them: glTexSubImage3D, region by
    /// region, never a union of distant regions. `bone` is the bone of the constructor, changed since. Call
    /// before drawing: if a frame in flight uses a texture, the call waits for that frame. Returns the
    /// changed voxels of grid(); valid until the next call.
    std::span<const VoxelBox> update(const Bone& bone, std::span<const BrickChange> changes);

    /// Adds a structure outside the bone, with a tissue's label, which thin bone shows. work() enters it.
    void add_structure(std::uint8_t label, StructureMask structure);
    /// A step of that work, of a few milliseconds. Returns the changed voxels, as update does; none: all is
    /// done.
    std::span<const VoxelBox> work(const Bone& bone);

    /// Plan of the textures: layout, coarsening and bytes.
    const TexturePlan& plan() const { return plan_; }
    /// The bytes of plan(), texture by texture.
    std::vector<TextureSize> sizes() const;
    /// The grid that is drawn: the bone's own or a coarser copy's.
    const Grid& grid() const { return grid_; }
    /// The part of grid() that the textures hold, in whole bricks.
    const VoxelBox& box() const { return places_.box(); }
    /// Places of the bricks of grid() in fraction(), colour_code() and surface_colours().
    const AtlasLayout& places() const { return places_; }

    const gl::Texture3D& fraction() const { return *fraction_; }
    /// The fractions, smoothed for normals; none if the shading does not use them, or memory is short.
    const gl::Texture3D* smoothed() const { return smoothed_ ? &smoothed_->texture() : nullptr; }
    /// Index into `colours` of each voxel, placed as the fractions are; none for a homogeneous, unlabelled
    /// bone.
    const std::optional<gl::Texture3D>& colour_code() const { return colour_code_; }
    /// Whether neighbours mostly have the same code, as within a tissue.
    bool codes_are_mostly_alike() const { return table_.codes.are_mostly_alike(); }
    /// Linear RGB and opacity of code i in texel (i, 0); in (i, 1) the strengths of its fine and coarse
    /// grain.
    const gl::Texture2D& colours() const { return colours_; }
    /// Display RGB times alpha, and alpha, of the surface voxels; none unless these are shaded.
    const gl::Texture3D* surface_colours() const { return surface_ ? &surface_->texture() : nullptr; }
    /// Whether the bone is seen through: opacities are then per millimetre.
    bool is_translucent() const { return table_.mode == TransferMode::translucent; }
    /// Voxels below the surface at which its colour is taken.
    double colour_depth_voxels() const { return osteomill::colour_depth_voxels(table_); }
    /// AtlasLayout::tile_table; none in a dense layout.
    const std::optional<gl::Texture3D>& tile_table() const { return tile_table_; }
    /// For each block of EmptySpace, two bytes: its mean fraction; and its distance, at most 127, with 128
    /// more if bone in it and two voxels about it has one code (blocks_of_one_code), where codes are mostly
    /// alike.
    const gl::Texture3D& blocks() const { return *blocks_; }

    /// Tissues that thin bone shows; null if it shows none.
    const SeenThrough* seen_through() const { return seen_ ? &*seen_ : nullptr; }
    /// By label, in texel (label, 0) linear RGB and strength, in (label, 1) the depth in voxels.
    const gl::Texture2D& seen_looks() const { return seen_looks_; }

    /// Where the piece is sawn off, in voxels of grid().
    const SawnFaces& sawn_faces() const { return sawn_faces_; }

    /// A point of patient space in texture coordinates counted in voxels: (0, 0, 0) is the box's corner.
    glm::dvec3 to_box_voxels(const glm::dvec3& position_mm) const;

  private:
    friend class TextureBuild;

    /// Without contents yet. `copy` is filled already.
    BoneTextures(const Bone& bone, std::optional<CoarseBone> copy, const TransferTable& table,
                 Shading shading, const TexturePlan& plan, int longest_edge_texels);
    /// Makes the textures, on `storage` if it is not null, and uploads all of the bone. Throws
    /// gl::NoTextureMemory.
    Steps fill(const Bone& bone, gl::StorageThread* storage);
    /// Uploads region by region.
    Steps for_all(const Bone& drawn, std::function<void(const PlacedVoxels&)> upload);
    const Bone& copied(const Bone& bone) const { return copy_ ? copy_->bone() : bone; }
    const Bone& shown(const Bone& bone) const { return visible_ ? visible_->bone() : copied(bone); }
    Steps find_blocks_of_one_code(const Bone& drawn);
    void upload_blocks(const VoxelBox& blocks);
    void store_seen_looks();

    TexturePlan plan_;
    TransferTable table_;
    Shading shading_;
    std::optional<CoarseBone> copy_;      ///< only where the bone itself exceeds the memory
    std::optional<VisibleBone> visible_;  ///< of the copy, if any; only where the look hides bone
    Grid grid_;
    AtlasLayout places_;
    EmptySpace empty_space_;
    std::vector<bool> has_one_code_;  ///< by block of empty_space_; empty if no look is blended by it
    std::optional<gl::Texture3D> fraction_;
    std::optional<gl::Texture3D> blocks_;
    std::optional<gl::Texture3D> tile_table_;
    std::optional<gl::Texture3D> colour_code_;
    gl::Texture2D colours_;
    std::optional<SmoothedTexture> smoothed_;
    std::optional<SurfaceTexture> surface_;
    std::optional<SeenThrough> seen_;
    gl::Texture2D seen_looks_;
    SawnFaces sawn_faces_;
    std::vector<VoxelBox> changed_;  ///< by the last update
    std::vector<std::uint8_t> scratch_;
};

/// Build of a bone's textures in steps of a few milliseconds: a head of 2048^3 voxels takes seconds, and
/// meanwhile the drawing thread must keep the window responsive.
///
/// The bone may be carved between steps. A step reads it in its present state, so all changes since the
/// beginning must be passed to BoneTextures::update at the end; the textures are then as if made of the final
/// bone. (Two things may differ: distances of empty space may be shorter than necessary and, in a coarser
/// copy, voxels keep the code of the fullest voxel at the time of reading.)
class TextureBuild {
  public:
    /// `bone` must keep its address, and everything except its fractions, while there are steps. A tissue
    /// without voxels makes nothing translucent: all bone would be drawn the slower way for it. `storage`
    /// makes the textures' memory; null: the steps do, however long that takes. Throws std::invalid_argument
    /// for an invalid transfer function.
    TextureBuild(const Bone& bone, std::vector<TissueColour> tissues, const ShadingSettings& look,
                 const TextureLimits& limits, gl::StorageThread* storage = nullptr);
    TextureBuild(const TextureBuild&) = delete;
    TextureBuild& operator=(const TextureBuild&) = delete;

    /// Goes on by a step. False: all is made. Throws std::runtime_error, naming sizes, as BoneTextures does.
    bool step() { return steps_.step(); }
    /// 0 to 1.
    double done() const { return steps_.done(); }

    /// The plan of the textures, once it is known.
    const std::optional<TexturePlan>& plan() const { return plan_; }
    /// Whether the driver had no memory for a better plan.
    bool has_settled_for_less() const { return has_settled_for_less_; }

    /// After the last step, once.
    BoneTextures take() { return std::move(*made_); }
    BoneTextures all_at_once();

  private:
    Steps build(const Bone& bone);
    Steps make_absent_opaque(const Bone& bone);

    std::vector<TissueColour> tissues_;
    ShadingSettings look_;
    TextureLimits limits_;
    gl::StorageThread* storage_;
    std::optional<TexturePlan> plan_;
    bool has_settled_for_less_ = false;
    std::optional<BoneTextures> made_;
    Steps steps_;  // last, since it works on the others
};

}  // namespace osteomill
