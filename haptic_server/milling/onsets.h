// Smooths the moments at which voxels are met. A second pass that is a fraction of a voxel deeper meets a
// whole row of voxels at once, each at its full rate of loss, and the next row a voxel later: the force, a
// sum over the points of a lattice of a rate that jumps where the burr meets the bone, is a sawtooth about
// the integral that it stands for. By the Euler-Maclaurin formula (Abramowitz and Stegun 1964, 23.1.30) a sum
// over points W apart, of a rate that jumps to r where the burr meets them, falls short of its integral by
//
//     -r B_1 = r (1/2 - D/W),    0 < D <= W: the way to the point that is met next
//
// to first order. W is the way on which the burr passes the next plane of the lattice across its main
// direction: 1 / max |v_k| for a unit direction v, in voxels. So each voxel that will be met within W on this
// course stands for a loss at that rate: first less than nothing, then as much more. A step of length L which
// has brought it within D is given
//
//     r (P(D + L) - P(D)),    P(D) = D/2 (1 - D/W) for 0 <= D <= W, and periodic
//
// where the period of P stands for the voxel before it in the row, met in this step. On the way from W to 0
// this adds up to nothing, on the mean over where the steps fall and whatever their length: means keep their
// value at every rate, nothing is remembered, nothing lags. A voxel with its centre at w from the burr's, met
// at the distance d = R + u where 1 - cover(u) (of cover.h) is what is left of it, has
//
//     D = q - sqrt(q^2 - (|w|^2 - d^2)),    q = w . v,      r = |cover'(u)| sqrt(...) / d
//
// and is never met where the root is of something negative. It is left out where the burr comes from beyond
// what a carve looks at (rim_voxels of cover.h) on part of the way W. The force of what it loses is that of
// the place where it will be met. Bone and account know nothing of all this.
//
// In free air nothing is smoothed: what is added is, in size, at most what the stretch has removed.
#pragma once

#include <array>
#include <span>

#include "common/bone/bone.h"
#include "haptic_server/milling/awaiting_voxels.h"
#include "haptic_server/milling/cover.h"
#include "haptic_server/milling/instruction_set.h"
#include "haptic_server/milling/removed_voxels.h"

namespace osteomill {

/// Of one stretch of the way. Scratch: made anew for each, and not cleared.
class Onsets {
  public:
    /// Whole voxels have no ramp: with them nothing is smoothed.
    Onsets(double radius_voxels, VoxelEdges edges, const BoneContent& content,
           InstructionSet instructions) noexcept;

    /// The stretch has removed so much. Real-time safe, as all the rest.
    void removed(double codes) noexcept { codes_left_ += codes; }

    /// Finds what the voxels are given that await the burr. Overwrites what it found before.
    void take(const AwaitingVoxels& awaiting) noexcept;

    /// Those that are given something, each where the burr will meet it: no whole numbers. Padded; none where
    /// the burr rests.
    const RemovedVoxels& voxels() const { return voxels_; }
    /// What they are given, relative stiffness times fraction, of either sign.
    std::span<const float> weights() const { return {weights_.data(), voxels_.count}; }

  private:
    /// The inner loop; in the source, where vectors are at home.
    struct Kernel;

    void find_plain(const AwaitingVoxels& awaiting) noexcept;
    void find_avx2(const AwaitingVoxels& awaiting) noexcept;
    void weigh() noexcept;

    float radius_;
    float reach_;
    VoxelEdges edges_;
    const BoneContent& content_;
    InstructionSet instructions_;
    double codes_left_ = 0.0;  // what may be given
    RemovedVoxels voxels_;
    alignas(64) std::array<float, RemovedVoxels::capacity> weights_;
};

static_assert(AwaitingVoxels::capacity <= RemovedVoxels::capacity);

}  // namespace osteomill
