#include "devices/client/client_device.h"
#include "devices/simulated/hand_and_arm.h"
#include "haptic_server/session/device_table.h"

namespace osteomill {

namespace {

DeviceParts make_client_device(const DeviceContext& context) {
    DeviceParts parts;
    parts.operator_channel = std::make_unique<OperatorChannel>();
    parts.device = std::make_unique<ClientDevice>(*parts.operator_channel, context.scene.start_pose,
                                                  context.scene.device, ArmModel{},
                                                  hand_model(context.grip.value_or(Grip::firm)));
    return parts;
}

}  // namespace

DeviceEntry client_entry() {
    return {.name = "client",
            .text = "a client's mouse",
            .is_moved_by_client = true,
            .checked = [](const TypedOptions&) { return at_once(make_client_device); }};
}

}  // namespace osteomill
