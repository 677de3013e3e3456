// Field of the tissues that thin bone shows: for every second voxel, the nearest tissue whose colour comes
// through bone (thin_bone.h), and its distance.
//
// A tissue consists of the voxels of its label that are at least half full, and of the soft structures that
// were added; milled away, it is no longer seen. Distances are from a voxel's centre to the tissue's nearest
// voxel, less half a voxel, negative within. They are computed by windows along one axis after the other, in
// pieces of the lattice, so that a change costs only the pieces near it.
//
// A slanted border is stairs of voxels, and its distances ripple. So each is smoothed over seven places along
// each axis: exact for a layer along the lattice, off by 0.07 voxels (rms; 0.14 before) about their mean for
// one aslant, by 0.04 (0.13) for a tube of 25 voxels' radius, which is 0.1 too close on average. A tube
// of 3.6 voxels' radius keeps its place, one of 1.5 is 0.4 too far at its surface, right from 2 voxels on.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/bone/brick_change.h"
#include "common/bone/structure_mask.h"
#include "render_client/volume/gl/texture.h"
#include "render_client/volume/steps.h"
#include "render_client/volume/textures/voxel_box.h"
#include "render_client/volume/thin_bone.h"

namespace osteomill {

/// Lattice of the field's values: every so many voxels of a bone's box, and one step beyond, since a
/// structure may lie just outside.
struct SeenLattice {
    explicit SeenLattice(const VoxelBox& of);

    VoxelBox box{};
    int step = 2;  ///< voxels
    glm::ivec3 places{0};
    std::size_t bytes() const { return 2 * VoxelBox{{}, places}.count(); }
};

class SeenThrough {
  public:
    /// Most voxels of bone through which a tissue is seen; a greater depth is cut down to it.
    static constexpr int most_depth_voxels = 48;

    /// Voxels have an edge of `spacing_mm`. The texture has the lattice's places, of
    /// VoxelFormat::interpolated_bytes.
    SeenThrough(const SeenLattice& lattice, double spacing_mm, const SeenTissues& tissues,
                gl::Texture3D texture);

    /// Computes all of it, once. Pass changes made meanwhile to update afterwards.
    Steps fill(const Bone& bone);

    /// Computes again the places that a change of the bone's labelled voxels can affect. Returns boxes of
    /// their voxels; valid until the next call.
    std::span<const VoxelBox> update(const Bone& bone, std::span<const BrickChange> changes);

    /// Adds a structure outside the bone, with a tissue's label; each of the bone's voxels stands for
    /// `coarsening` of the structure's grid along an edge. work() enters it.
    void add(std::uint8_t label, StructureMask structure, int coarsening);
    /// Enters a piece of the added structures, and returns its voxels; an empty box: all is done.
    VoxelBox work(const Bone& bone);

    /// Two bytes a place: nearness, the tissue's number.
    const gl::Texture3D& texture() const { return texture_; }
    /// The number of the tissue with that label: above 0, and as far from all others as a byte allows, so
    /// that a number between two places shows whether they have the same tissue; 0 if it is not seen.
    std::uint8_t number_of(std::uint8_t label) const { return numbers_[label]; }
    const SeenLattice& lattice() const { return lattice_; }
    /// Distance, voxels, at a nearness n from 0 to 1: farthest_voxels() - n span_voxels().
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
    /// Gathers the labels of these voxels; false if none is seen.
    bool gather(const Bone& bone, const VoxelBox& voxels);
    bool gather_soft(const Soft& soft, const VoxelBox& voxels);
    /// Distances and labels of these places, before they are smoothed.
    void find_distances(const VoxelBox& places, const VoxelBox& voxels);
    void find_nearest(const VoxelBox& places, const VoxelBox& voxels, int window, bool of_tissue);
    /// The lattice in pieces.
    std::vector<VoxelBox> pieces() const;
    /// Places that see a voxel of the box; none for an empty box.
    VoxelBox places_near(const VoxelBox& voxels) const;
    VoxelBox voxels_of(const VoxelBox& places) const;

    SeenLattice lattice_;
    double spacing_mm_;
    SeenTissues tissues_;
    std::array<std::uint8_t, 256> numbers_{};  ///< by label
    double depth_voxels_ = 0.0;                ///< the greatest
    gl::Texture3D texture_;
    std::vector<bool> slot_shows_;  ///< has voxels of a tissue that is seen
    std::vector<Soft> soft_;
    std::vector<VoxelBox> due_;  ///< places
    std::vector<VoxelBox> changed_;

    // State of the piece under way: labels of its voxels; of the nearest after each axis, squared distance
    // and label; distances and labels of its places.
    std::vector<std::uint8_t> label_of_voxel_;
    std::array<std::vector<std::int32_t>, 3> nearest_;
    std::vector<float> distances_, smoothed_;  ///< voxels
    std::vector<std::uint8_t> labels_;
    std::vector<std::uint8_t> texels_;
};

}  // namespace osteomill
