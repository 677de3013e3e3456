// The devices that --device takes. To add one is a file and a row: the file has a function that gives the
// row, as those here do.
#pragma once

#include <string>
#include <vector>

#include "haptic_server/session/device_entry.h"

namespace osteomill {

/// The first is the default.
const std::vector<DeviceEntry>& devices();

/// Throws std::invalid_argument for a name that is not there.
const DeviceEntry& find_device(const std::string& name);

/// Without a command line: an arm in a hand that follows the scene's trajectory; without a grip on rails.
DeviceParts simulated_hand(const Scene& scene, std::optional<Grip> grip, const ArmModel& arm = {});

DeviceEntry simulated_entry();
DeviceEntry client_entry();
DeviceEntry hid_entry();
DeviceEntry space_mouse_entry();
DeviceEntry bridge_entry();
DeviceEntry tracker_entry();
DeviceEntry haply_entry();

}  // namespace osteomill
