// Burr as a massless proxy, tied to the device by a spring and held by the bone: backward Euler, solved
// each tick against the engagement map that the milling loop last sampled.
//
//     K_c (x - p - d) + F(d) = 0      for the step d of the proxy p toward the device x
//
//     spindle on, the milling force at the step's end:
//         F(d) = sum over patches of C_i (w_i max(0, n_i . d - cut_i)
//                                         + (1 - w_i) max(0, n_i . d - max(gap_i, cut_i))) / dt
//     spindle off, bone is a wall:
//         F(d) = - sum of k A_i n_i max(0, n_i . (p + d - p_map) - gap_i)
//
// C_i, n_i, gap_i and A_i as in engagement.h, with gaps counted from p in the first; cut_i is how far the
// patch may advance in what the proxy has cut since the map was sampled, so no bone is felt twice. Gaps of
// freshly carved bone scatter by about a tenth of a voxel, more than a burr advances in a tick: a patch whose
// gap is near a fifth of a voxel may touch or not, and counts as touching by the weight w_i, which falls from
// 1 to 0 between a tenth and three tenths. A threshold would let it come and go with the lattice. Piecewise
// linear: Newton on the set of patches in contact, a few iterations, halving a step that does not reduce the
// residual. In one dimension, in bone of resistance B, it is p' = (B/dt p + K_c x) / (B/dt + K_c): stable for
// any B.
//
// A massless burr that breaks through, or that its own teeth pull along, would be elsewhere within a tick,
// and the hand would feel the spring let go all at once. A handpiece has mass: with the spindle on, the burr
// slips past the hand no faster than most_slip_mm_per_s, and the spring lets go over some ticks. The hand
// never gets more than the spring held.
//
// Each tick ends in one of three ways, and the counters say in which:
//
//   balanced   the residual is under 1 mN (contact_solve.h); so it is in all but rare ticks
//   with mass  a ring of contacts whose edges pull sideways can leave a massless burr no balance: the law is
//              not monotone, with eigenvalues down to about -B/2 for a resistance B. With a mass m and steps
//              of h there is one as soon as m/h exceeds B/2. So the tick is done again with handpiece_kg,
//              from the last tick's speed, in `substeps` that remember what each patch has cut.
//   relaxed    a substep without a balance keeps the contacts' normal forces alone. That always has a
//   solution,
//              and only takes energy out.
//
// Bone that pulls the burr along (a climb cut at an edge) gives it energy, and the spring would hand that on
// to the hand. A store counts what bone has given, less what it took, and forgets with energy_memory_s. A
// tick in which bone would add to a store that holds more than allowed_energy_mj is solved with a damper
// between burr and hand, which the hand does not feel: the burr then follows the hand, rather than its teeth.
// A burr that bone holds back, or that has left it, is never damped: the spring lets go at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "haptic_server/coupling/contact_solve.h"
#include "haptic_server/coupling/force_correction.h"
#include "haptic_server/coupling/solve_counts.h"
#include "haptic_server/exchange/milling_step.h"

namespace osteomill {

class BurrProxy {
  public:
    explicit BurrProxy(double spring_n_per_mm) : spring_n_per_mm_(spring_n_per_mm) {}

    /// Puts the proxy somewhere, in contact with nothing that it knows of.
    void place(const glm::dvec3& position_mm) noexcept;

    /// One tick of `tick_s` toward `target_mm` (patient LPS). In free air the proxy follows there. Real-time
    /// safe.
    void advance(const glm::dvec3& target_mm, double tick_s, bool spindle_on,
                 const MillingResult& latest) noexcept;

    const glm::dvec3& position_mm() const { return position_mm_; }
    /// Iterations that the last advance took, for benchmarks.
    int iterations() const { return iterations_; }
    const SolveCounts& counts() const { return counts_; }

    /// Between these gaps a patch counts as touching by a share.
    static constexpr double surely_touching_voxels = 0.1;
    static constexpr double surely_apart_voxels = 0.3;
    /// Wall pressure per depth with the spindle off, N/mm^3: a 1 mm burr pressed with 3 N sinks in by 0.04
    /// mm.
    static constexpr double wall_n_per_mm3 = 1000.0;
    /// Above the hand's own speed. On a spring of 1.5 N/mm 0.15 N a tick, half of what is felt as a knock.
    static constexpr double most_slip_mm_per_s = 100.0;

    /// Of the burr where it is solved with a mass: a light dental handpiece.
    static constexpr double handpiece_kg = 0.1;
    static constexpr int substeps = 10;
    static constexpr double energy_memory_s = 0.05;
    static constexpr double allowed_energy_mj = 0.1;
    /// So that what bone gave is forgotten soon after it has stopped.
    static constexpr double most_remembered_mj = 0.3;
    /// Between burr and hand while bone gives energy.
    static constexpr double runaway_damping_n_s_per_mm = 1.0;

  private:
    /// What a step of the burr did, before and after it was held back.
    struct Outcome {
        glm::dvec3 step_mm{0.0};
        glm::dvec3 bone_force_n{0.0};  // on the burr, mean over the tick
        double energy_mj = 0.0;        // that bone gave the burr
        double residual_n = 0.0;
        bool is_relaxed = false;
    };

    void take_over(const MillingResult& latest) noexcept;
    /// Contacts that a step of `step_s` may meet that is no longer than `longest_mm`.
    std::span<const Contact> gather_contacts(double longest_mm, double step_s, bool spindle_on,
                                             const Engagement& engagement) noexcept;
    void remember_cuts(const Engagement& engagement) noexcept;
    Outcome step_without_mass(const glm::dvec3& pull_mm, const glm::dvec3& hand_step_mm, double tick_s,
                              bool is_damped, const Engagement& engagement) noexcept;
    Outcome step_with_mass(const glm::dvec3& pull_mm, const glm::dvec3& hand_step_mm, double tick_s,
                           bool is_damped, const Engagement& engagement) noexcept;
    /// With the spindle on; moves the burr and counts.
    void cut_toward(const glm::dvec3& target_mm, double tick_s, const Engagement& engagement) noexcept;
    void press_toward(const glm::dvec3& target_mm, double tick_s, const Engagement& engagement) noexcept;

    double spring_n_per_mm_;
    glm::dvec3 position_mm_{0.0};
    glm::dvec3 target_mm_{0.0};          // of the last tick
    glm::dvec3 velocity_mm_per_s_{0.0};  // over the last tick
    double given_mj_ = 0.0;              // what bone has given lately
    std::uint64_t map_step_ = 0;
    ForceCorrection correction_;
    SolveCounts counts_;
    int iterations_ = 0;
    std::array<double, Engagement::max_patches>
        cut_mm_{};  // by patch: advance from p_map to which the proxy has cut
    std::array<Contact, 2 * Engagement::max_patches> contacts_{};  // a patch may have two
};

}  // namespace osteomill
