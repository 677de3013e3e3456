// Bone without voxels around one burr, in continuous time: the truth of the cutting scene mills it.
//
// The burr's surface is split into patches of equal area, rings of constant height times equal angles. A
// patch resists in proportion to the rate at which it cuts new bone along its normal n, by the law of
// engagement.h,
//
//     F = sum over patches of C u + E min(1, u / u_0),  u = max(0, n . w - gap / h)
//
// with w the velocity over a substep of h, E the force of edges that rub, which is there as soon as the patch
// cuts, and u_0 so slow (0.01 mm/s) that nobody tells it from rest,
//
// and has no bone before it until it has closed its gap. The cut bone is the union of the spheres along the
// path so far, the slot included: refresh() measures each patch's gap against it (the ray along the normal,
// up to where it leaves the last sphere); in between gaps follow the motion linearly. So a burr that draws
// back, sways or returns meets only bone that is still there. The bone's flat surface {z = 0} cuts the rings:
// each counts with the share of its height that lies below.
//
// The spindle points along +z. Patches reach `headroom_mm` higher than the burr is deep; a burr that sinks
// farther feels too little. mm, s, N.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill::study {

class SweptBone {
  public:
    static constexpr double headroom_mm = 1.0;

    /// The burr stands at `start_mm` at the end of a slot that it has cut along +x.
    SweptBone(const Burr& burr, double relative_stiffness, const glm::dvec3& start_mm);

    /// The velocity w that the burr has over the next substep where its motion is held back by `resistance`
    /// and driven by `drive_n`:  resistance w = drive + F(w).  Newton on the set of cutting patches.
    glm::dvec3 solve(const glm::dvec3& resistance_n_s_per_mm, const glm::dvec3& drive_n, double substep_s);

    /// Moves the burr by a step and cuts.
    void advance(const glm::dvec3& step_mm);

    /// Measures all gaps anew. To be called every millisecond or so.
    void refresh();

    const glm::dvec3& burr_mm() const { return burr_mm_; }

  private:
    void make_patches(double stiffness);
    /// The solve with edges that rub: each step of Newton's is as long as it lowers the residual.
    glm::dvec3 solve_with_edges(const glm::dmat3& of_tool, const glm::dvec3& drive_n, double substep_s);
    /// Finds the patches that cut, and those whose edges rub with all their force, at velocity w; makes them
    /// the current sets, and returns whether these changed.
    bool engage(const glm::dvec3& velocity_mm_per_s, double substep_s);
    /// Raises gaps to the space that the path's spheres with a distance in (beyond, within] have cleared.
    void look_at_path(double beyond_mm, double within_mm, std::vector<float>& gap_mm) const;
    /// A patch's state: 0 in air, 1 cutting more slowly than u_0, 2 cutting.
    std::uint8_t state_at(std::size_t patch, const glm::vec3& step_mm, float slow_mm) const;
    /// Adds (or subtracts) a patch's effect in a state.
    void add(std::size_t patch, std::uint8_t state, double sign);

    Burr burr_;
    glm::dvec3 burr_mm_;

    // By patch. Single precision: a gap is good to 1e-8 mm, a substep moves by 1e-5.
    std::vector<float> normal_x_, normal_y_, normal_z_, gap_mm_, far_gap_mm_;
    std::vector<std::uint8_t> engaged_, engaged_next_;
    std::vector<glm::dvec3> whole_n_s_per_mm_;  // law of a patch that is wholly in bone
    std::vector<glm::dvec3> whole_edge_n_;      // force of the edges on such a patch
    std::vector<double> share_in_bone_;
    double patch_area_mm2_ = 0.0;
    double ring_height_mm_ = 0.0;
    std::size_t patches_per_ring_ = 0;

    bool has_engaged_ = false;            // since the last refresh
    glm::dmat3 force_per_velocity_{0.0};  // the engaged patches'
    glm::dvec3 force_per_gap_rate_{0.0};
    glm::dvec3 edge_force_n_{0.0};  // patches' that rub with all their force
    glm::dvec3 last_velocity_{0.0};
    std::vector<glm::dvec3> path_mm_;
    glm::dvec3 looked_far_from_mm_{0.0};  // where far_gap_mm_ was measured
    int refreshes_ = 0;
};

}  // namespace osteomill::study
