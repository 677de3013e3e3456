// Interface of the couplings, which stand between the force model and the hand: from the model's result and
// the device's state to the force of this haptic tick and the burr's next pose.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "common/scene/scene.h"
#include "common/session/tool_state.h"
#include "simulation/coupling/fixture_pull.h"
#include "simulation/device/haptic_device.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// The device at this tick, in patient space.
struct HandState {
    double now_s = 0.0;
    double tick_s = 0.001;
    ToolPose pose;
    glm::dvec3 velocity_mm_per_s{0.0};
    bool spindle_on = false;
    std::size_t burr = 0;
    double speed_share = 1.0;                ///< of the spindle's speed to the burr's own
    FixtureSet fixtures_on = every_fixture;  ///< of those that the coupling has
};

struct CouplingOutput {
    glm::dvec3 force_n{0.0};  ///< on the hand, patient axes; not yet clamped
    ToolPose burr_pose;       ///< where the milling loop shall take the burr next
    /// Moment of the bone on the shank, about the burr's centre, where force_n acts; patient axes.
    glm::dvec3 shank_torque_n_mm{0.0};
};

class Coupling {
  public:
    virtual ~Coupling() = default;

    /// One haptic tick. `latest` is the milling loop's newest result (step 0: none yet). Real-time safe.
    virtual CouplingOutput tick(const HandState& hand, const MillingResult& latest) noexcept = 0;

    /// Outcomes of the solves so far; zero for a coupling that does not solve.
    virtual SolveCounts solve_counts() const noexcept { return {}; }

    /// The scene's fixtures as felt in the last tick; none after a reset.
    virtual FeltFixtures felt_fixtures() const noexcept { return {}; }

    /// Clears all state, as after a fault or a jump of the device: the next tick starts from the hand's pose.
    virtual void reset() noexcept = 0;

    /// A copy that goes on from here alike. Between ticks.
    virtual std::unique_ptr<Coupling> copy() const = 0;
};

struct CouplingOptions {
    PatientLimits device;
    double milling_period_s = 0.001;
    /// The model has no cutting law, and its force is the wall, too: with the spindle off a coupling renders
    /// that force, makes no wall of its own and leaves the burr at the hand.
    bool model_holds_wall = false;
    /// Coulomb's coefficient of a burr at rest on bone, for couplings that solve a balance.
    double wall_friction = 0.0;
    bool feed_forward = false;  ///< of bone's change, for the coupling that has one (feed_forward.h)
    std::shared_ptr<const Fixtures> fixtures{};  ///< null: none; else only of couplings that take them
};

}  // namespace osteomill
