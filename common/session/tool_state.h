// The state of the tool, the one type for it from the haptic loop to the picture. Plain data without
// pointers: the loop hands it on without allocating.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>

#include "common/scene/burr.h"
#include "common/scene/fixture.h"
#include "common/session/bounded_line.h"

namespace osteomill {

/// Outcomes of a coupling's contact solves since the start of a session: the largest residual, and how often
/// the plain solve failed.
struct SolveCounts {
    double max_residual_n = 0.0;  ///< largest force left over after a tick
    std::uint64_t fallbacks = 0;  ///< ticks without a balance, until they were damped
    std::uint64_t relaxed = 0;    ///< of these, ticks in which normal forces alone were kept
    std::uint64_t damped = 0;     ///< ticks with a balance, damped because bone drove the burr off

    bool operator==(const SolveCounts&) const = default;
};

/// The client that moves the tool, as seen by the client that this is sent to.
enum class ToolDriver {
    unknown,  ///< no client: the server has a device of its own, or is too old to send it
    nobody,   ///< the next that sends input
    you,
    another,      ///< whose lease has not run out: input is ignored
    others_only,  ///< this client may only watch, its input is ignored; another may hold the tool
};

/// State of the cut of a burr's edges, in few numbers: the force within the tooth period, for the sound of
/// the cut. The felt force does not depend on it.
struct CutState {
    double force_n = 0.0;  ///< of the bone on the burr, mean over the last tooth periods
    /// Amplitude of that force's first harmonic of the tooth period; 0 if the force model has no edges.
    double tooth_ripple_n = 0.0;
    double relative_stiffness = 1.0;  ///< of the bone in front of the edges; 1: cortical bone
    /// Speed of the spindle under the load. Nothing if the scene has no motor.
    std::optional<double> loaded_rpm{};

    bool operator==(const CutState&) const = default;
};

/// Positions and forces in patient LPS. On the wire it is the message of the same name.
struct ToolState {
    double time_s = 0.0;                 ///< session time
    glm::dvec3 burr_position_mm{0.0};    ///< centre of the burr's sphere
    glm::dvec3 spindle_axis{0, 0, 1.0};  ///< unit, from tip to shank
    glm::dvec3 hand_position_mm{0.0};    ///< where the device is; leads the burr by what the coupling yields
    glm::dvec3 force_n{0.0};             ///< on the hand, as written to the device
    std::size_t burr = 0;                ///< index into the session's burrs
    bool spindle_on = false;
    double removed_mm3 = 0.0;  ///< since the server began
    bool touches_protected = false;
    BoundedLine fault{};   ///< why the force is off; empty while all is well
    BoundedLine notice{};  ///< the reason for which a request waits; empty: none waits
    /// The server's wall clock when it took this off the haptic loop, ns since 1970; 0: unknown.
    std::int64_t taken_unix_ns = 0;
    ToolDriver driver = ToolDriver::unknown;  ///< set for each client by the streaming server
    /// Depth of the burr's tip below where it first met bone, along the spindle axis of that moment; 0
    /// before. Nothing if the server does not send it.
    std::optional<double> depth_mm{};
    /// Nothing if the server does not send it.
    std::optional<SolveCounts> solve{};
    /// Moment of the bone on the shank, about the burr's centre. Nothing if no burr has a shank, or the
    /// server does not send it.
    std::optional<glm::dvec3> shank_torque_n_mm{};
    /// Largest force on the hand since the server began. Nothing if the server does not send it.
    std::optional<double> peak_force_n{};
    /// Speed of the spindle if it is not the burr's own: it was chosen, or is changing to the chosen one.
    std::optional<double> spindle_rpm{};
    /// State of the edges' cut; the streaming server adds it. Nothing if nothing is cut, or it is not sent.
    std::optional<CutState> cut{};
    FixtureSet fixtures_on = 0;      ///< of the scene's
    FixtureSet fixtures_acting = 0;  ///< of those, which push, hold or slow the burr now
};
static_assert(std::is_trivially_copyable_v<ToolState>);

/// Speed of the spindle while it turns; `burr` is the tool's; rev/min.
inline double spindle_rpm(const ToolState& tool, const Burr& burr) {
    return tool.spindle_rpm.value_or(60.0 * burr.spindle_rev_per_s);
}

// Appearance of a tool: whether two states of it look the same in a picture.

/// Less than a pixel, and about the tremble of a good arm's encoders.
inline constexpr double quiet_motion_mm = 0.002;
/// Less than a plot shows.
inline constexpr double quiet_force_n = 0.002;

/// Whether a viewer that received `sent` would see nothing new in `now`, except for the time. Compare with
/// the state sent last, not with the previous frame, so that slow motion is sent, too.
bool looks_the_same(const ToolState& sent, const ToolState& now);

}  // namespace osteomill
