#include <variant>

#include "devices/simulated/hand_and_arm.h"
#include "devices/simulated/trajectory.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/measured_device.h"
#include "haptic_server/session/recorded_arm.h"

namespace osteomill {

namespace {

/// The recorded motion's; any other motion has the simulated arm.
DeviceLimits arm_on_rails(const Scene& scene, const ArmModel& simulated) {
    const auto* file = std::get_if<std::filesystem::path>(&scene.trajectory.source);
    return (file != nullptr ? arm_of_trajectory(*file) : std::nullopt).value_or(limits_of(simulated));
}

}  // namespace

DeviceParts simulated_hand(const Scene& scene, std::optional<Grip> grip, const ArmModel& arm) {
    Trajectory trajectory =
        make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr);
    auto simulated =
        grip ? std::make_unique<SimulatedDevice>(std::move(trajectory), scene.device, arm, hand_model(*grip))
             : std::make_unique<SimulatedDevice>(std::move(trajectory), scene.device,
                                                 arm_on_rails(scene, arm));
    DeviceParts parts;
    parts.simulated = simulated.get();
    parts.device = std::move(simulated);
    return parts;
}

DeviceEntry simulated_entry() {
    return {.name = "simulated",
            .text = "a hand that follows a trajectory",
            .options = {measured_profile_option()},
            .is_simulated = true,
            .is_arm = true,
            .checked = [](const TypedOptions& typed) {
                return PrepareDevice([load = typed_measured_profile(typed)]() -> MakeDevice {
                    return [profile = load()](const DeviceContext& context) {
                        return with_measured(simulated_hand(context.scene, context.grip), profile, context);
                    };
                });
            }};
}

}  // namespace osteomill
