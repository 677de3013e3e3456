// What the command line of haptic_server says of the device that moves the tool.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "common/net/listen_address.h"
#include "devices/bridge/bridge_address.h"

namespace osteomill {

enum class DeviceKind { simulated, client, hid, space_mouse, bridge, tracker, haply };

/// As --device has it.
std::string name_of(DeviceKind device);

struct DeviceChoice {
    DeviceKind device = DeviceKind::simulated;
    std::string device_profile = "woodenhaptics_v2015";  ///< a shipped profile's name or a TOML file
    bool lists_devices = false;                          ///< and does nothing else
    BridgeAddress bridge = ListenAddress{.port = 7020};  ///< of DeviceKind::bridge
    std::optional<std::filesystem::path> bridge_key;     ///< a secret that its arm has, too
    ListenAddress tracker{.port = 18944};        ///< of DeviceKind::tracker: its server; on this machine
    std::string tracker_name;                    ///< of its TRANSFORMs; empty: the first that comes
    std::filesystem::path tracker_registration;  ///< of DeviceKind::tracker
    ListenAddress haply{.port = 10001};          ///< of DeviceKind::haply: its service; on this machine
};

class DeviceOptions {
  public:
    /// Adds the options. Outlives the parsing.
    void declare(CLI::App& app);
    /// After parsing. Throws std::invalid_argument with one line for options that do not go together.
    DeviceChoice checked() const;

  private:
    void check_bridge(DeviceChoice& choice) const;
    void check_tracker(DeviceChoice& choice) const;
    void check_haply(DeviceChoice& choice) const;

    std::string device_ = "simulated";
    std::string device_profile_;
    std::string bridge_;
    std::string bridge_key_;
    std::string tracker_;
    std::string tracker_name_;
    std::string tracker_registration_;
    std::string haply_;
    bool lists_devices_ = false;
};

}  // namespace osteomill
