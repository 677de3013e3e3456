// Three hands enter bone on the same line: one whose burr is rigidly the hand, without any loop's delay (the
// exact answer), one with an ideal spring, and one with a coupling of the program on the map of the milling
// model.
//
//     exact      m dv/dt = hand - b v - dW/dt, backward Euler in steps of 20 us
//     ideal      the coupling's own spring, damper and filters (coupling_spring.h), each millisecond in
//                balance with the bone's impulse: K (x - p) + B (v - w) = (W(p') - W(p)) / T
//     coupling   the program's, milling and haptic loop at 1 kHz in turns
//
// So the ideal one is the best that a coupling with that spring can do, and its distance from the coupling is
// what the engagement map loses. A hand is led along the line at its speed (prescribed), or a firm hand holds
// the arm, which is guided along the line, and means to go so. No encoder steps, no Coulomb friction, no
// limit of the arm's force. Only the coupling's burr may be pushed aside: in a plunge nothing pushes it.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"

namespace osteomill::study {

/// A burr that enters bone along a line, and the bone's impulse by its way there.
///
/// A chip's force times the time that it takes is the same however fast the burr is, so the impulse of the
/// bone depends on the way s alone, and the law of a burr that is rigidly the hand is
///
///     F = -dW/dt = -(dW/ds) v        W: impulse of the burr on the bone up to s, N s
///
/// Bone that is cut does not resist again: on the way back F is zero until the burr is as deep as before.
enum class OnsetKind {
    plunge,  ///< along the spindle into a surface: one-dimensional, since sideways forces cancel
    entry    ///< across the spindle into the side of a block, at a steady depth under its top
};

struct Onset {
    Burr burr;  ///< a ball, whose edges do not rub
    OnsetKind kind = OnsetKind::plunge;
    /// Way out of the bone, of a plunge; unit. Anything but an axis lies aslant in the lattice.
    glm::dvec3 up{0.0, 0.0, 1.0};
    double depth_mm = 0.45;         ///< of an entry: the burr's lowest point's under the top
    double way_mm = 0.5;            ///< beyond the first touch, which the hand means to go; up to 3
    double speed_mm_per_s = 20.0;   ///< to there, where it stops
    double before_touch_mm = 0.35;  ///< that the hand starts from the first touch
};

/// The line on which the burr's centre goes; patient axes.
struct OnsetLine {
    glm::dvec3 start_mm{0.0};
    glm::dvec3 direction{0.0};  ///< unit, into the bone
    glm::dvec3 spindle_axis{0.0};

    glm::dvec3 at(double way_mm) const { return start_mm + way_mm * direction; }
};

OnsetLine line_of(const Onset& onset);

/// The bone that is entered, in voxels of 0.1 mm.
Bone bone_of(const Onset& onset);

/// The milling model's force of a burr on the line, summed over steps of some micrometres. Throws
/// std::invalid_argument for a burr that is no ball or whose edges rub: the force of these is no chip's.
class ImpulseByWay {
  public:
    explicit ImpulseByWay(const Onset& onset);

    /// Impulse of the bone on the burr from the start of the line to `way_mm` (0 or more), N s, patient axes.
    glm::dvec3 at(double way_mm) const;
    /// Its part along the line, negative where bone resists.
    double along(double way_mm) const;

    static constexpr double step_mm = 0.004;
    /// Beyond the way that the hand means to go, to where the bone is known; on from there it resists as
    /// at the end.
    static constexpr double beyond_mm = 0.6;

  private:
    glm::dvec3 direction_;
    std::vector<glm::dvec3> impulses_n_s_;  // at multiples of step_mm
};

struct OnsetHand {
    std::string coupling = "implicit";  ///< as of --coupling
    bool feed_forward = false;          ///< of bone's change, of a coupling that has one
    double stiffness_n_per_mm = 1.5;    ///< of the spring, above 0
    double damping_n_s_per_mm = 0.004;
    bool is_guided = false;  ///< by a firm hand; else prescribed
};

/// Forces on the hand, a tick a millisecond, patient axes.
struct OnsetRun {
    std::vector<glm::dvec3> exact_n;
    std::vector<glm::dvec3> ideal_n;
    std::vector<glm::dvec3> felt_n;  ///< with the coupling
};

/// Until a prescribed hand stops, or a tenth of a second after a guided one means to. Throws
/// std::invalid_argument for an unknown coupling, a spring that is none, a speed or way that is not above 0,
/// and as ImpulseByWay does.
OnsetRun run_onset(const Onset& onset, const OnsetHand& hand);

struct OnsetPeak {
    double peak_n = 0.0;   ///< largest mean over 5 ms
    double half_ms = 0.0;  ///< when that mean first exceeds half of `of_peak_n`; the run's length if never
};

OnsetPeak peak_of(const std::vector<glm::dvec3>& forces_n, double of_peak_n);

}  // namespace osteomill::study
