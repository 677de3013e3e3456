#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "devices/hid/hid_arm.h"
#include "devices/hid/hidapi_transport.h"
#include "devices/hid/profile_file.h"
#include "haptic_server/session/device_table.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/thread_priority.h"

namespace osteomill {

namespace {

constexpr const char* profile_flag = "--device-profile";
constexpr const char* usual_profile = "woodenhaptics_v2015";

DeviceParts make_hid_arm(const std::string& name) {
    const ArmProfile profile = load_arm_profile(name);
    DeviceParts parts;
    parts.home_mm = home_position_mm(profile);
    parts.transport = std::make_unique<HidapiTransport>();
    parts.device = std::make_unique<HidArm>(
        profile, *parts.transport, [clock = std::make_shared<const RealClock>()] { return clock->now_s(); },
        [] { ask_for_real_time(device_priority); });
    return parts;
}

}  // namespace

DeviceEntry hid_entry() {
    return {.name = "hid",
            .text = "a haptic arm over USB HID",
            .options = {{.flag = profile_flag,
                         .type_name = "NAME|FILE.toml",
                         .help = fmt::format("Which haptic arm: {}, or a TOML file of your own ({})",
                                             fmt::join(shipped_profile_names(), ", "), usual_profile),
                         .names_file = true}},
            .checked = [](const TypedOptions& typed) {
                return at_once([name = typed.given(profile_flag).value_or(usual_profile)](
                                   const DeviceContext&) { return make_hid_arm(name); });
            }};
}

}  // namespace osteomill
