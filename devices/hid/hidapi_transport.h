// HID devices through hidapi and the kernel's hidraw.
#pragma once

#include "devices/hid/hid_transport.h"

namespace osteomill {

/// Advice about installation, for a user without permission.
inline constexpr const char* udev_rule = "scripts/udev/70-osteomill.rules";

class HidapiTransport final : public HidTransport {
  public:
    std::vector<HidDeviceInfo> list() override;
    std::unique_ptr<HidConnection> open(const std::string& path) override;
};

}  // namespace osteomill
