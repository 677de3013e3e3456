// Field of what thin bone shows: how far every second voxel is from the nearest tissue whose colour comes
// through bone (thin_bone.h), and which tissue that is.
//
// A tissue is there where bone with its label is at least half full, and in the soft structures that were
// added; milled away, it is seen no more. Distances are from a voxel's centre to the tissue's nearest voxel,
// less half a voxel, negative within; exact for a layer along the lattice, up to 0.2 voxels too long for one
// aslant. By windows along one axis after the other, in pieces of the lattice, so that a change costs what is
// near it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/bone/brick_change.h"
#include "common/bone/structure_mask.h"
#include "render_client/volume/gl/texture3d.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/voxel_box.h"
#include "render_client/volume/thin_bone.h"

namespace osteomill {

/// Where the field has values: every so many voxels of a bone's box and one step beyond, where a structure
/// may lie just outside.
struct SeenLattice {
    explicit SeenLattice(const VoxelBox& of);

    VoxelBox box{};
    int step = 2;  ///< voxels
    glm::ivec3 places{0};
    std::size_t bytes() const { return 2 * VoxelBox{{}, places}.count(); }
};

class SeenThrough {
  public:
    /// No tissue is seen through more voxels of bone than this; deeper ones are cut down to it.
    static constexpr int most_depth_voxels = 48;

    /// Of voxels of `spacing_mm`. The texture has the lattice's places, of VoxelFormat::interpolated_bytes.
    SeenThrough(const SeenLattice& lattice, double spacing_mm, const SeenTissues& tissues,
                gl::Texture3D texture);

    /// Computes all of it, once. Pass what changes meanwhile to update afterwards.
    Steps fill(const Bone& bone);

    /// Computes again what a change of the bone's labelled voxels can have changed. Returns boxes of voxels
    /// whose places it computed; valid until the next call.
    std::span<const VoxelBox> update(const Bone& bone, std::span<const BrickChange> changes);

    /// A structure outside the bone, with a tissue's label; each of the bone's voxels stands for so many of
    /// the structure's grid along an edge. work() takes it in.
    void add(std::uint8_t label, StructureMask structure, int coarsening);
    /// Takes a piece of the added structures in, and returns its voxels; of none, nothing is left to do.
    VoxelBox work(const Bone& bone);

    /// Two bytes a place: nearness, the label.
    const gl::Texture3D& texture() const { return texture_; }
    const SeenLattice& lattice() const { return lattice_; }
    /// Distance, voxels, of a nearness from 0 to 1: the first less the second times that.
    double farthest_voxels() const { return depth_voxels_; }
    double span_voxels() const { return depth_voxels_ + deepest_voxels(); }
    /// Depth of a tissue, voxels.
    double depth_voxels(const SeenTissue& tissue) const;

  private:
    struct Soft {
        std::uint8_t label;
        StructureMask mask;
        int coarsening;
    };
    double deepest_voxels() const { return lattice_.step + 1; }
    int reach() const;
    void mark_bricks(const Bone& bone, std::size_t slot);
    /// Computes and uploads these places.
    void compute(const Bone& bone, const VoxelBox& places);
    /// Labels of these voxels; false where none is seen.
    bool gather(const Bone& bone, const VoxelBox& voxels);
    bool gather_soft(const Soft& soft, const VoxelBox& voxels);
    void find_nearest(const VoxelBox& places, const VoxelBox& voxels, int window, bool of_tissue);
    /// The lattice in pieces.
    std::vector<VoxelBox> pieces() const;
    /// Places that see a voxel of the box; none for a box that is none.
    VoxelBox places_near(const VoxelBox& voxels) const;
    VoxelBox voxels_of(const VoxelBox& places) const;

    SeenLattice lattice_;
    double spacing_mm_;
    SeenTissues tissues_;
    double depth_voxels_ = 0.0;  ///< the greatest
    gl::Texture3D texture_;
    std::vector<bool> slot_shows_;  ///< has voxels of a tissue that is seen
    std::vector<Soft> soft_;
    std::vector<VoxelBox> due_;  ///< places
    std::vector<VoxelBox> changed_;

    // Of the piece under way: labels of its voxels; squared distances and labels after each axis.
    std::vector<std::uint8_t> label_of_voxel_;
    std::array<std::vector<std::uint16_t>, 3> squares_;
    std::array<std::vector<std::uint8_t>, 3> labels_;
    std::vector<std::uint8_t> texels_;
};

}  // namespace osteomill
