// The seam between the drivers and USB HID: hidapi on one side (hid_transport.cpp), a script in the tests.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace osteomill {

struct HidDeviceInfo {
    std::string path;  ///< such as /dev/hidraw0
    std::uint16_t vendor_id = 0;
    std::uint16_t product_id = 0;
    std::uint16_t usage_page = 0;
    std::uint16_t usage = 0;
    std::string product{};  ///< as the device calls itself
};

/// One line with the obstacle to opening a device, and the remedy.
class HidOpenError : public std::runtime_error {
  public:
    HidOpenError(const std::string& message, bool needs_permission)
        : std::runtime_error(message), needs_permission_(needs_permission) {}
    /// The device is there and this user may not use it.
    bool needs_permission() const { return needs_permission_; }

  private:
    bool needs_permission_;
};

/// A device that was opened; closed by its destructor. One thread at a time.
class HidConnection {
  public:
    static constexpr int gone = -1;

    virtual ~HidConnection() = default;

    /// Takes the oldest report that waits, or waits up to `wait_ms` for one. Bytes of the report, 0 for none,
    /// or `gone`. Does not allocate while the device is there.
    virtual int read(std::span<std::uint8_t> into, int wait_ms) noexcept = 0;

    /// Sends a report that begins with its number (0: not numbered); false if the device did not take it. A
    /// USB device may take a millisecond or two to take it.
    virtual bool write(std::span<const std::uint8_t> report) noexcept = 0;
};

class HidTransport {
  public:
    virtual ~HidTransport() = default;

    /// The devices that are plugged in now. Not real-time safe, like open.
    virtual std::vector<HidDeviceInfo> list() = 0;

    /// Throws HidOpenError.
    virtual std::unique_ptr<HidConnection> open(const std::string& path) = 0;
};

// HID devices through hidapi and the kernel's hidraw.

/// Advice about installation, for a user without permission.
inline constexpr const char* udev_rule = "scripts/udev/70-osteomill.rules";

class HidapiTransport final : public HidTransport {
  public:
    std::vector<HidDeviceInfo> list() override;
    std::unique_ptr<HidConnection> open(const std::string& path) override;
};

}  // namespace osteomill
