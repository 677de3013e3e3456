// Where the chip ends near the spindle's axis. A burr that leans forward cuts with its tip, and the bone's
// free face may pass the axis within a voxel or two. The means of axis_means.h leave the force of a chip that
// goes on as it is, since e / r is harmonic; that of a chip with an edge near the axis they do not, by up to
// a fifth of the force of a burr fifteen voxels thick. Four things put it right.
//
// What the means miss. The integral of e / r over a chip has a kink where the chip's edge passes the axis,
// which the means round off; that of 1 / r, too. Where the face is known tip_disc.h says by how much. Of a
// chip that goes on it says a little, since the chip does not quite go on as a plane: of that, the share that
// is there is left out.
//
// Where a voxel's bone lies. A voxel of which the share l is left loses what lies (l - 1/2) N off its middle,
// N the outward normal of the face: bone goes from the face down, and a voxel that was never full lacks what
// would lie above. By the ramp of cover.h this goes when the middle is at the depth g under the burr's
// surface, whereas its own turn is when it lies on that surface itself. Of the way between the two places,
// that across the face is
//
//     ((l - 1/2) + g cos theta) / sin theta   along u,   cos theta = -N . n,
//
// seen along the axis: in steady motion the face keeps its distance, so that bone moves along it. All voxels
// near the tip are moved by their own, so nobody needs to know which are at the face, nor how soft the ramp
// is.
//
// Where the face is. Over the voxels that lost something, moved to the burr's surface and with r < A, sums
// of the volume and its first moment say what tip_disc.h says of a face: of its place and direction the ones
// that fit best are found by Gauss and Newton's method from a guess. How the face is inclined these hardly
// show, but all that the step removed does: for a face of which N . v = 0 in steady motion, the sum of n over
// it lies in the plane of v and N. A way of a few of a voxel's 255 steps tells little: all sums remember
// three voxels of the way, so that the mean force does not depend on the tick. What they say is scaled by
// what the step cut, which in air is nothing.
//
// How the tip's force swings. As voxels pass the axis it does, by several percent where the rest of the force
// cancels or is small. That of the disc, counted by 1 - r^2 / A^2, is for each bit of what the burr removes
// the force that it was over those three voxels of the way; what is moved swings more, and so is that. A
// share of the tip that changes by more than the lattice makes it counts at once.
//
// Used by the mean over voxels (cutting_force.h); the instants of tooth_force.h and the bins of chip_map.h do
// without.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptic_server/milling/instruction_set.h"
#include "haptic_server/milling/tip_disc.h"

namespace osteomill {

/// What the sum over voxels needs so that it can look for the face. Burr axes, voxels.
struct TipSearch {
    bool is_on = false;
    /// Where bone lies beside its voxel's middle, for each 1 of l - 1/2 and for each voxel of g.
    glm::vec2 per_level{0.0f};
    glm::vec2 per_depth{0.0f};
};

/// Of voxels, each counted by the share of it that was lost; voxels, burr axes.
struct TipSums {
    double volume = 0.0;     ///< over the disc, times 1 - r^2 / A^2
    glm::dvec2 moment{0.0};  ///< of that
    double stiffness = 0.0;  ///< relative, times that volume
    glm::dvec3 force{0.0};   ///< of that volume, in the units of the sum of forces
    glm::dvec3 moved{0.0};   ///< by what the sum of forces grows if bone is moved to where it lies
    double all = 0.0;        ///< of all voxels, times their relative stiffness
    glm::dvec3 places{0.0};  ///< of all voxels, from the burr's centre
};

/// The face, as the last three voxels of the way have shown it. Real-time safe but for its construction.
class TipEdge {
  public:
    explicit TipEdge(InstructionSet instructions) : disc_(instructions) {}

    /// The centre of a burr of `radius_voxels` moves by `way_voxels`, patient axes; `frame`: burr axes in
    /// patient axes. A way on which the tip does not advance, and a burr hardly thicker than the disc,
    /// forget.
    void begin_step(const glm::dmat3& frame, double radius_voxels, const glm::dvec3& way_voxels) noexcept;

    /// Of the step.
    const TipSearch& search() const noexcept { return search_; }

    /// Of voxels that the step lowered.
    void add(const TipSums& sums) noexcept;

    /// All of the step is added: looks for the face. What the step's sum of weight times (the mean of e / r,
    /// cos kappa times that of 1 / r) has missed; burr axes, voxels^2.
    glm::dvec3 end_step() noexcept;

    /// By what the step's sum of forces changes where bone lies beside its voxel's middle, and where the
    /// tip's force is that of three voxels of the way; burr axes.
    glm::dvec3 evened() const noexcept;

  private:
    struct Found {
        FaceAtTip face{};
        glm::dvec3 missing{0.0};  // for a way of one voxel
        double trust = 0.0;       // 0: none, 1: sure
    };
    /// What shows over the disc, for a way of one voxel.
    struct Seen {
        double volume = 0.0;
        glm::dvec2 moment{0.0};
    };
    void forget() noexcept;
    double cot_theta() const noexcept;
    /// `share` of the whole chip's volume that is seen.
    FaceAtTip face_that_shows(const Seen& seen, double share, const TipDiscSums& whole) const noexcept;
    Found find() const noexcept;

    TipDisc disc_;
    TipSearch search_;
    glm::dmat3 frame_{1.0};
    glm::dvec3 direction_{0.0, 0.0, -1.0};  // of the way, burr axes
    // What the step has added to the sums below.
    double step_all_ = 0.0;
    double step_stiffness_ = 0.0;
    glm::dvec3 step_force_{0.0};

    // Of the face that was found last; patient axes, since the burr may turn.
    glm::dvec3 per_level_{0.0};
    glm::dvec3 per_depth_{0.0};

    // Fading sums; vectors in patient axes.
    double way_sum_ = 0.0;
    double all_sum_ = 0.0;
    double volume_sum_ = 0.0;
    double stiffness_sum_ = 0.0;
    glm::dvec3 moment_sum_{0.0};
    glm::dvec3 force_sum_{0.0};
    glm::dvec3 moved_sum_{0.0};
    glm::dvec3 places_sum_{0.0};
};

}  // namespace osteomill
