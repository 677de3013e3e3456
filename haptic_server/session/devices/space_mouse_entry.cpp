#include <memory>

#include "devices/hid/hid_transport.h"
#include "devices/hid/space_mouse.h"
#include "devices/simulated/hand_and_arm.h"
#include "haptic_server/session/device_table.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

DeviceParts make_space_mouse(const DeviceContext& context) {
    DeviceParts parts;
    parts.transport = std::make_unique<HidapiTransport>();
    parts.device = std::make_unique<SpaceMouse>(
        context.scene, ArmModel{}, hand_model(context.grip.value_or(Grip::firm)), *parts.transport,
        [clock = std::make_shared<const RealClock>()] { return clock->now_s(); },
        [] { ask_for_real_time(device_priority); });
    return parts;
}

}  // namespace

DeviceEntry space_mouse_entry() {
    return {.name = "spacemouse",
            .text = "a 3D mouse, whose force clients show",
            .checked = [](const TypedOptions&) { return at_once(make_space_mouse); }};
}

}  // namespace osteomill
