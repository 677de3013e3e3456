// Burr as a massless proxy, pulled by a coupling's spring and damper and held by the bone: backward Euler,
// solved each tick against the engagement map that the milling loop last sampled.
//
//     pull(d) + F(d) = 0      for the step d of the proxy p toward the hand x
//
//     spindle on, the milling force at the step's end:
//         F(d) = sum over patches of C_i (w_i max(0, n_i . d - cut_i)
//                                         + (1 - w_i) max(0, n_i . d - max(gap_i, cut_i))) / dt
//     spindle off, bone is a wall:
//         F(d) = - sum of k A_i n_i max(0, n_i . (p + d - p_map) - gap_i)
//
// C_i, n_i, gap_i and A_i as in engagement.h, with gaps counted from p in the first; cut_i is how far the
// patch may advance in bone that the proxy has cut since the map was sampled, so no bone is felt twice. Gaps
// of freshly carved bone scatter by a fortieth of a voxel (rms) and at most 0.08, as much as a slow burr
// advances in a tick: a patch whose gap is that small may touch or not, and counts as touching by the weight
// w_i, which falls from 1 to 0 over the scatter. A threshold would let it come and go with the lattice; a
// wider fall counts bone as touched too early, and makes the first touch twice as hard as it is.
// Piecewise linear: Newton on the set of patches in contact (contact_solve.h). With a spring alone and in one
// dimension, in bone of resistance B, it is p' = (B/dt p + K_c x) / (B/dt + K_c): stable for any B.
//
// Edges that rub give a patch a force that does not go with its advance: it is there as soon as the patch
// touches, and holds the burr until the pull overcomes it, as dry friction does. It is made elastic: each
// patch gives way by edge_yields_mm before it cuts, and the burr that carves trails the proxy by up to
// carving_trails_mm, so that the pressed-in depth is still there when the next map comes.
//
// The shank meets bone as a wall, with the spindle on and off, and so does the head at bone that no burr
// cuts:
//
//     F(d) = - sum of k A_j n_j max(0, n_j . (p + d - p_map) - gap_j)
//
// in the same balance. The hand tilts a shank without resistance, and a rim between two rings of samples is
// met late, so a shank may be deeper in bone than any force pressed it. Bone pushes it out no faster than
// most_push_out_mm_per_s; at once, it would throw the hand. The push is no cutting force, so the gain that
// compares cutting forces with the model's leaves it out. The store of the energy with which bone drives the
// burr leaves it out, too, since a wall returns no more energy than it took. The hand sets the tool's
// direction, which is not solved.
//
// The pull is the spring's and damper's of coupling_spring.h, so the hand feels exactly the force of the bone
// on the burr, with two exceptions.
//
// First, a massless burr that breaks through would reach the hand within a tick, and the hand would feel the
// spring relax all at once. The same would happen when a spindle stops and the bone that pulled the burr
// along becomes a wall. A real handpiece has mass, and a real spindle slows down. So the force of spring and
// damper falls no faster than most_release_n_per_s: the burr moves no farther in a tick, and they relax over
// some ticks.
//
// Second, edges pull sideways, so bone can drive the burr along: the symmetric part of its resistance may
// have a negative eigenvalue -N. Then the burr may run away from the hand, and a ring of such contacts may
// leave no balance at all. Such a tick is solved again with a damper between burr and hand that the hand does
// not feel: a matrix, a small multiple of the negative part of that resistance, so it damps only the
// directions in which bone drives. A multiple over 1 makes the law monotone again: it has one balance, and
// the burr stays with the hand. In all other directions the spring relaxes as usual when bone is gone. If the
// hand moves the way the spring pulls it, the damper holds the burr still: dragged along, the burr would keep
// the spring stretched, and the damper would give the hand energy. Two energies show that the burr runs away:
// F . d, with which bone drives it, and F . (d - the hand's step), which separates it from the hand. The
// smaller one goes into a store that forgets with apart_memory_s; up to allowed_apart_mj in it, a tick with a
// balance is not damped. A tick without a balance even with the damper (counted; rare, where a shank jams)
// keeps only the contacts' normal forces: these always have a balance, and only take energy out.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/session/tool_state.h"
#include "simulation/coupling/contact_solve.h"
#include "simulation/coupling/force_correction.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// Between these gaps a patch counts as touching by a share.
struct TouchingGaps {
    double touching_voxels;
    double apart_voxels;
};

class BurrProxy {
  public:
    /// `wall_friction`: Coulomb's coefficient with the spindle off. `arm`: on whose spring the burr is.
    explicit BurrProxy(double wall_friction = 0.0, const PatientLimits& arm = {})
        : wall_friction_(wall_friction),
          scale_(arm.scale),
          wall_n_per_mm3_(std::max(wall_n_per_mm3, arm.scale.stiffness_n_per_mm(wall_n_per_mm3))) {}

    /// Puts the proxy somewhere, without any known contact.
    void place(const glm::dvec3& position_mm) noexcept;

    /// One tick of `tick_s` toward `target_mm` (patient LPS), which the proxy reaches in free air; `pull` is
    /// the coupling's on the burr. `hand_mm` is the hand's position; its step limits the energy that bone may
    /// give it, and how fast the spring may let go. Real-time safe.
    void advance(const glm::dvec3& target_mm, const glm::dvec3& hand_mm, const LinearPull& pull,
                 double tick_s, bool spindle_on, const MillingResult& latest) noexcept;

    /// One tick toward the hand against only the bone that no burr cuts, spindle on or off: for couplings
    /// whose burr is otherwise free.
    void advance_on_walls(const glm::dvec3& hand_mm, const LinearPull& pull, double tick_s,
                          const MillingResult& latest) noexcept;

    /// Resistance of the bone that the burr cuts to a step from where it is, N s/mm: the part of its force
    /// against the step, over the step's speed, 0 if it drives. `latest` as in the last advance; a step of 0
    /// meets none. Real-time safe.
    double resistance_n_s_per_mm(const glm::dvec3& step_mm, const MillingResult& latest) const noexcept;

    const glm::dvec3& position_mm() const { return position_mm_; }
    /// Position of the carving burr: the proxy's, less the depth by which a patch yields before its edges
    /// cut.
    const glm::dvec3& carving_mm() const { return carving_mm_; }
    /// Iterations that the last advance took, for benchmarks.
    int iterations() const { return iterations_; }
    const SolveCounts& counts() const { return counts_; }
    /// Whether bone, in the last advance, pushed on the shank, or on the head without being cut. With the
    /// spindle off only a push on the shank is reported.
    bool touches_wall() const { return walls_.force_n != glm::dvec3(0.0); }
    /// Moment of the push on the shank about the burr's centre, N mm, patient axes.
    const glm::dvec3& shank_torque_n_mm() const { return walls_.torque_n_mm; }

    /// For a milling loop at 500 Hz or more; and for a slower one, whose burr meets many voxels between two
    /// maps, and feels the lattice as a ripple unless it is smoothed.
    static constexpr TouchingGaps quick_gaps{0.04, 0.11};
    static constexpr TouchingGaps slow_gaps{0.1, 0.3};
    static constexpr double longest_quick_period_s = 0.002;
    /// Depth by which a patch gives way before its edges cut, and how far the carving burr may trail, since a
    /// patch that lies nearly along the motion yields, too.
    static constexpr double edge_yields_mm = 0.001;
    static constexpr double carving_trails_mm = 0.005;
    /// Wall pressure per depth with the spindle off, N/mm^3: a 1 mm burr pressed with 3 N sinks in by 0.04
    /// mm, and no farther at the arm either.
    static constexpr double wall_n_per_mm3 = 1000.0;
    /// Speed, at the arm, with which bone pushes out a shank that is deeper in it than the pull presses it:
    /// slower than a hand that yields.
    static constexpr double most_push_out_mm_per_s = 5.0;
    /// Rate at which spring and damper may let go: 0.15 N a tick, half of a knock that is felt.
    static constexpr double most_release_n_per_s = 150.0;

    // Energies are the hand's, at the arm.
    static constexpr double apart_memory_s = 0.05;
    static constexpr double allowed_apart_mj = 0.05;
    static constexpr double most_apart_mj = 1.0;
    /// Hidden damping over the drive of the bone, both in N s/mm; 1 would be just enough.
    static constexpr double drive_to_damping = 2.0;
    /// Damping for a tick that has no balance although nothing seems to drive the burr.
    static constexpr double least_damping_n_s_per_mm = 0.02;
    static constexpr int most_attempts = 6;
    /// Far below any spring's stiffness.
    static constexpr double negligible_drive_n_per_mm = 1e-3;

  private:
    /// Force of bone that is a wall, and its moment on the shank.
    struct WallReaction {
        glm::dvec3 force_n{0.0};
        glm::dvec3 torque_n_mm{0.0};
    };

    /// Advances of a patch along its normal from where the proxy is at which it meets bone that is there, and
    /// for the share that may not touch yet.
    struct Reach {
        double share = 0.0;  ///< that touches
        double begins_mm = 0.0;
        double begins_beyond_gap_mm = 0.0;
    };

    void take_over(const MillingResult& latest) noexcept;
    Reach reach_of(std::size_t patch, const Engagement& engagement) const noexcept;
    /// The kinds of contact at the head that a step may meet.
    enum class Meets : std::uint8_t { chips, walls_only, all_as_walls };

    /// Contacts that a step of `step_s`, no longer than `longest_mm`, may meet; `pull_n` is the pull on the
    /// burr at rest.
    std::span<const Contact> gather_contacts(double longest_mm, double step_s, Meets meets,
                                             const glm::dvec3& pull_n, const Engagement& engagement) noexcept;
    /// Reaction at the end of a step of the proxy for which contacts were gathered.
    WallReaction wall_reaction(const glm::dvec3& step_mm, const Engagement& engagement) const noexcept;
    void remember_cuts(const Engagement& engagement) noexcept;
    /// Moves the carving burr along with the proxy, which bone holds or does not.
    void trail(bool is_held, const Engagement& engagement) noexcept;
    /// The balance of a tick, damped if bone drives the burr.
    ContactStep balance_with_bone(const LinearPull& pull, const glm::dvec3& hand_step_mm, double tick_s,
                                  std::span<const Contact> contacts, const Engagement& engagement) noexcept;
    /// With the spindle on.
    void cut_toward(const glm::dvec3& target_mm, const glm::dvec3& hand_mm, const LinearPull& pull,
                    double tick_s, const Engagement& engagement) noexcept;
    /// Without cutting.
    void press_toward(const glm::dvec3& target_mm, const LinearPull& pull, double tick_s, Meets meets,
                      const Engagement& engagement) noexcept;
    /// Moves by a step toward the target, or by as much of it as spring and damper may release in a tick.
    void move(const glm::dvec3& step_mm, const glm::dvec3& target_mm, const LinearPull& pull,
              double tick_s) noexcept;

    void remember_pull(const LinearPull& pull, const glm::dvec3& before_mm,
                       const glm::dvec3& target_mm) noexcept;

    double wall_friction_;
    glm::dvec3 pulled_n_{0.0};  // of spring and damper on the burr in the last tick; 0 where it is the hand
    ArmScale scale_;
    double wall_n_per_mm3_;
    glm::dvec3 position_mm_{0.0};
    glm::dvec3 carving_mm_{0.0};
    glm::dvec3 target_mm_{0.0};  // of the last tick
    glm::dvec3 hand_mm_{0.0};    // of the last tick
    double apart_mj_ = 0.0;      // that bone lately spent on setting burr and hand apart
    std::uint64_t map_step_ = 0;
    double map_time_s_ = 0.0;    // session time of the map
    double map_period_s_ = 0.0;  // since the map before; 0: not known
    ForceCorrection correction_;
    SolveCounts counts_;
    int iterations_ = 0;
    std::array<double, Engagement::max_patches>
        cut_mm_{};  // by patch: advance from p_map to which the proxy has cut
    WallReaction walls_;
    std::array<double, Engagement::max_shank_patches> shank_begins_mm_{};  // from where the proxy is
    std::array<Contact, 2 * Engagement::max_patches + Engagement::max_shank_patches>
        contacts_{};  // a patch of the burr may have two
};

}  // namespace osteomill
