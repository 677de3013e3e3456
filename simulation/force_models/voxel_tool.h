// Voxelised tool, after Morris, Sewell, Barbagli, Salisbury, Blevins and Girod, "Visuohaptic simulation
// of bone surgery for training and evaluation", IEEE Computer Graphics and Applications 26(6), 2006
// (equations from general knowledge of the paper): the burr is a set of voxels; each that is immersed in bone
// pushes toward the burr's centre with a unit vector, and the force grows with their number,
//
//     u = sum_i w_i e_i / |sum_i w_i e_i|,   e_i from voxel i to the burr's centre,
//     F = k V u,                             V = sum_i w_i h^3, the volume of bone within the burr,
//
// here with the burr's voxels on the bone's lattice, w_i = cover of voxel i by the burr times the fraction of
// it that is bone (1 or 0 in the paper), and V for the number of voxels, so that the force depends on no
// voxel size. In flat bone V is the spherical cap pi d^2 (R - d/3). Hard and soft bone push alike; with the
// burr wholly within bone the vectors cancel, and the force has faded out (trust_in_direction()).
#pragma once

#include "simulation/force_models/contact_law.h"
#include "simulation/force_models/erosion.h"

namespace osteomill {

struct VoxelToolSettings {
    double stiffness_n_per_mm3 = 0.6;  ///< k: 1.1 N for a 5 mm burr at 0.5 mm, where it stiffens to 4 N/mm
    double erosion_per_s = default_erosion_per_s;
};

class VoxelTool final : public ContactLaw {
  public:
    explicit VoxelTool(const VoxelToolSettings& settings = {}) : settings_(settings) {}

    ContactReaction react(const BurrContact& contact) noexcept override;
    std::unique_ptr<ContactLaw> copy() const override { return std::make_unique<VoxelTool>(*this); }

  private:
    VoxelToolSettings settings_;
};

}  // namespace osteomill
