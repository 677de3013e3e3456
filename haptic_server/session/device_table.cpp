#include "haptic_server/session/device_table.h"

#include <algorithm>
#include <stdexcept>

namespace osteomill {

const std::vector<DeviceEntry>& devices() {
    static const std::vector<DeviceEntry> table{simulated_entry(),   client_entry(), hid_entry(),
                                                space_mouse_entry(), bridge_entry(), tracker_entry(),
                                                haply_entry()};
    return table;
}

const DeviceEntry& find_device(const std::string& name) {
    const auto found = std::ranges::find_if(devices(), [&](const auto& entry) { return name == entry.name; });
    if (found == devices().end()) throw std::invalid_argument("there is no device \"" + name + "\"");
    return *found;
}

}  // namespace osteomill
