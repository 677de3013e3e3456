// List of devices that `haptic_server --list-devices` prints.
#pragma once

#include <string>
#include <vector>

#include "devices/hid/hid_transport.h"

namespace osteomill {

/// A line for each haptic arm and 3D mouse: its path, its kind, and whether it can be opened, or the remedy.
/// Tries to open each. One line if there is none.
std::string device_list(HidTransport& transport);

/// The same devices, by whether they can be opened: each with its path and the remedy.
struct HidReadiness {
    std::vector<std::string> ready{};
    std::vector<std::string> closed{};
};
HidReadiness readiness_of_devices(HidTransport& transport);

}  // namespace osteomill
