#include "devices/hid/device_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <vector>

#include "common/text/foreign_text.h"
#include "devices/hid/arm_profile.h"
#include "devices/hid/hid_arm.h"
#include "devices/hid/space_mouse.h"

namespace osteomill {

namespace {

/// The use that a device can have; empty for a keyboard and the like.
std::string use_of(const HidDeviceInfo& device) {
    std::vector<std::string> profiles;
    for (const std::string& name : shipped_profile_names())
        if (is_arm_of(load_arm_profile(name).usb, device)) profiles.push_back(name);
    if (!profiles.empty())
        return fmt::format("haptic arm: --device hid --device-profile {} or your own .toml",
                           fmt::join(profiles, "|"));
    return is_space_mouse(device) ? "3D mouse, moves the tool without a force: --device spacemouse" : "";
}

struct Usable {
    HidDeviceInfo device;
    std::string use;
    bool is_ready;
    std::string text;  ///< where it is, and why not
};

/// A device with several uses is listed once.
std::vector<Usable> usable_devices(HidTransport& transport) {
    std::vector<Usable> found;
    std::set<std::string> seen;
    for (const HidDeviceInfo& device : transport.list()) {
        const std::string use = use_of(device);
        if (use.empty() || !seen.insert(device.path).second) continue;
        try {
            transport.open(device.path);
            found.push_back({device, use, true, fmt::format("{}: ready", device.path)});
        } catch (const HidOpenError& error) {
            found.push_back({device, use, false, error.what()});
        }
    }
    return found;
}

}  // namespace

std::string device_list(HidTransport& transport) {
    std::string text;
    for (const auto& [device, use, is_ready, readiness] : usable_devices(transport))
        text += fmt::format("{:04x}:{:04x} {}\n    {}\n    {}\n", device.vendor_id, device.product_id,
                            printable(device.product), use, readiness);
    return text.empty() ? "no haptic arm and no 3D mouse is plugged in\n" : text;
}

HidReadiness readiness_of_devices(HidTransport& transport) {
    HidReadiness found;
    for (const Usable& usable : usable_devices(transport))
        (usable.is_ready ? found.ready : found.closed).push_back(usable.text);
    return found;
}

}  // namespace osteomill
