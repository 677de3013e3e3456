// Where the chip ends near the spindle's axis. A burr that leans forward cuts with its tip, and the bone's
// free face may pass the axis within a voxel or two. The means of axis_means.h leave the force of a chip that
// goes on as it is, since e / r is harmonic; that of a chip with an edge near the axis they do not, by up to
// an eighth of the force of a burr ten voxels thick. Three things put it right.
//
// What the means miss. Let the chip have the thickness c where y < d and end there. Its integral of e / r has
// a kink at d = 0, with a slope of pi c on either side, which the means round off. What they leave out points
// along u, from the cut to where it is missing. With s = |d| / a, W the weights w of axis_means.h integrated
// along the edge, and M as there,
//
//     missing = c u int_{y<d} (1 - M) y / r^2 dA = -c u int_|d|^a (pi - 2 pi int_0^e W) de
//             = c u a (1 - s)^4 (-0.427 + 1.434 s + 3.162 s^2),   s < 1, within 0.4 % of its value at 0.
//
// The same of 1 / r, which is zero at d = 0, is left alone.
//
// Where a voxel's bone lies. A voxel at the free face is full up to that face: its bone lies below its
// middle, and by how much depends on where the lattice lies (3 % of the force of that burr). What goes when
// the share l of a voxel is left lay (l - 1/2) N off its middle, N the normal of the face, and goes when the
// middle is 1/2 - l under the burr's surface, whereas its own turn was when that was (l - 1/2) N . n. Moved
// by the one, and by the way between the other two, it lay (l - 1/2) tan(theta / 2) u beside the voxel's
// middle in the plane of the tip, cos theta = -N . n. What a full voxel loses is moved to and fro by the same
// in turn, so nobody needs to know which voxels are at the face. In steady motion the face keeps its
// distance: N . v = 0, so that cot theta = (u . v) / (n . v).
//
// Where the edge is. Over the voxels that lost something, with t = (r / A)^2 on the burr's surface and (x, y)
// seen along the axis, each counted by the area of a whole chip that it stands for,
//
//     area   = sum (1 - t) cos kappa * fraction lost / (n . way),   pi A^2 / 2 where all is cut,
//     moment = the same of (x, y) = -4/15 A^3 (1 - d^2 / A^2)^(5/2) u.
//
// A is large enough for these not to tell where the lattice lies. With v = 1 - (2 - 2 area / all)^0.4, d / A
// = v (1.4527 - v (0.8582 - v (0.6053 - 0.2006 v))) where d > 0, within 0.001. The face cuts the burr in an
// arc, which has moved that line toward the cut by its mean sagitta, (A^2 - d^2) cot theta / (10 R). A way
// of a few of a voxel's 255 steps tells little, and what is moved swings as the lattice passes: all sums
// remember two voxels of the way, so that the mean force does not depend on the tick. What they say is
// scaled by what the step cut, which in air is nothing.
//
// Used by the mean over voxels (cutting_force.h); the instants of tooth_force.h and the bins of chip_map.h do
// without.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace osteomill {

/// Radius A, voxels.
inline constexpr float tip_disc_voxels = 3.3f;

/// What the sum over voxels needs so that it can look for the edge. Burr axes.
struct TipSearch {
    bool is_on = false;
    glm::vec3 direction{0.0f};  ///< of the way of the burr's centre; unit
    float least_share = 1.0f;   ///< of that way, along a normal, that a chip is taken to have
    glm::vec2 per_level{0.0f};  ///< where bone lies, voxels from its voxel's middle, for each 1 of l - 1/2
};

/// Sums over the disc; voxels.
struct TipSums {
    double area = 0.0;       ///< times the way
    double stiffness = 0.0;  ///< relative, times that
    glm::dvec2 moment{0.0};  ///< times the way; burr axes
    glm::dvec3 moved{0.0};   ///< by what the sum of forces grows if bone is moved to where it lies; burr axes
};

/// The edge, as the last two voxels of the way have shown it. Real-time safe.
class TipEdge {
  public:
    /// The centre of a burr of `radius_voxels` moves by `way_voxels`, patient axes; `frame`: burr axes in
    /// patient axes. A way on which the tip does not advance enough for the whole disc to cut forgets.
    void begin_step(const glm::dmat3& frame, double radius_voxels, const glm::dvec3& way_voxels) noexcept;

    /// Of the step.
    const TipSearch& search() const noexcept { return search_; }

    /// Of voxels that the step lowered.
    void add(const TipSums& sums) noexcept;

    /// What the step's sum of weight times the mean of e / r has missed so far; burr axes, voxels^2.
    glm::dvec2 missing() const noexcept;

    /// By what the step's sum of forces grows since bone lies beside its voxel's middle; burr axes.
    glm::dvec3 moved() const noexcept;

    /// What was cut so far says nothing of what comes.
    void forget() noexcept;

  private:
    struct Edge {
        glm::dvec2 outward{0.0};       // u
        double distance_voxels = 0.0;  // d
        double shift_per_level = 0.0;  // tan(theta / 2)
        double trust = 0.0;            // 0: none, 1: sure
    };
    Edge edge() const noexcept;

    TipSearch search_;
    glm::dmat3 frame_{1.0};
    double radius_voxels_ = 1.0;
    glm::dvec3 way_{0.0};     // burr axes
    double step_area_ = 0.0;  // what the step has added to area_sum_

    // Fading sums; vectors in patient axes, since the burr may turn.
    double way_sum_ = 0.0;
    double area_sum_ = 0.0;
    double stiffness_sum_ = 0.0;
    glm::dvec3 moment_sum_{0.0};
    glm::dvec3 moved_sum_{0.0};
};

}  // namespace osteomill
