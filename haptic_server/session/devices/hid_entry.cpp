#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_arm.h"
#include "devices/hid/hid_transport.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/measured_device.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

constexpr const char* usual_profile = "woodenhaptics_v2015";

DeviceParts make_hid_arm(const std::string& name, const DeviceContext& context) {
    const ArmProfile profile = load_arm_profile(name);
    DeviceParts parts;
    parts.home_mm = home_position_mm(profile);
    parts.profile = arm_profile_text(name);
    parts.transport = std::make_unique<HidapiTransport>();
    parts.device = std::make_unique<HidArm>(
        profile, *parts.transport, [clock = std::make_shared<const RealClock>()] { return clock->now_s(); },
        [] { ask_for_real_time(device_priority); });
    if (!profile.measured) return parts;
    return with_measured(std::move(parts), MeasuredProfile{profile.name, *profile.measured}, context);
}

}  // namespace

DeviceEntry hid_entry() {
    return {.name = "hid",
            .text = "a haptic arm over USB HID",
            .options = {{.flag = device_profile_flag,
                         .type_name = "NAME|FILE.toml",
                         .help = fmt::format("Which haptic arm: {}, or a TOML file of your own ({})",
                                             fmt::join(shipped_profile_names(), ", "), usual_profile),
                         .names_file = true,
                         .is_replaced_by = save_profile_flag}},
            .is_arm = true,
            .checked = [](const TypedOptions& typed) {
                return at_once([name = typed.given(device_profile_flag).value_or(usual_profile)](
                                   const DeviceContext& context) { return make_hid_arm(name, context); });
            }};
}

}  // namespace osteomill
