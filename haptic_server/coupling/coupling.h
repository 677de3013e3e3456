// What stands between the milling model and the hand: from model output and device state to the force of this
// haptic tick, and to where the burr goes.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "haptic_server/device/haptic_device.h"
#include "haptic_server/exchange/milling_step.h"

namespace osteomill {

/// The device at this tick, in patient space.
struct HandState {
    double now_s = 0.0;
    double tick_s = 0.001;
    ToolPose pose;
    glm::dvec3 velocity_mm_per_s{0.0};
    bool spindle_on = false;
    std::size_t burr = 0;
};

struct CouplingOutput {
    glm::dvec3 force_n{0.0};  ///< on the hand, patient axes; not yet clamped
    ToolPose burr_pose;       ///< where the milling loop shall take the burr next
};

class Coupling {
  public:
    virtual ~Coupling() = default;

    /// One haptic tick. `latest` is the milling loop's newest result (step 0: none yet). Real-time safe.
    virtual CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept = 0;

    /// Forgets everything, as after a fault or a jump of the device: the next tick starts from the hand's
    /// pose.
    virtual void reset() noexcept = 0;
};

struct CouplingOptions {
    DeviceLimits device;
    double milling_period_s = 0.001;
    double position_resolution_mm = 0.0;  ///< of the device's encoders, in patient space; 0: not to speak of
    /// The model's force is the wall, too, and it has no cutting law: with the spindle off a coupling renders
    /// that force, makes no wall of its own and leaves the burr where the hand is.
    bool model_holds_wall = false;
};

struct CouplingEntry {
    std::string name;
    std::string description;         ///< a few words for --help
    bool needs_cutting_law = false;  ///< it solves one: not with a force model that has none
    bool is_interpolated = false;    ///< a line between two model forces, as the published method has it
};

/// In the order of --help; the first is the default.
std::vector<CouplingEntry> couplings();
std::vector<std::string> coupling_names();

/// What --coupling takes, in one line: the names, and how those of direct_coupling.h are combined with a
/// virtual damper (BASE+damper) or passivity control (BASE+passivity).
std::string coupling_choices();

/// Of a name or a combination. Throws std::invalid_argument with the choices for what is neither.
CouplingEntry find_coupling(const std::string& name);

/// Throws as coupling_method does, and std::invalid_argument for a coupling that needs a cutting law with a
/// model that has none.
std::unique_ptr<Coupling> make_coupling(const std::string& name, const CouplingOptions& options);

}  // namespace osteomill
