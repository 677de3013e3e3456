#include "haptic_server/program/device_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "common/program/option_checks.h"
#include "devices/hid/profile_file.h"
#include "devices/tracker/transform_stream.h"

namespace osteomill {

namespace {

struct NamedDevice {
    const char* name;
    DeviceKind kind;
};
constexpr std::array named_devices{NamedDevice{"simulated", DeviceKind::simulated},
                                   NamedDevice{"client", DeviceKind::client},
                                   NamedDevice{"hid", DeviceKind::hid},
                                   NamedDevice{"spacemouse", DeviceKind::space_mouse},
                                   NamedDevice{"bridge", DeviceKind::bridge},
                                   NamedDevice{"tracker", DeviceKind::tracker},
                                   NamedDevice{"haply", DeviceKind::haply}};

std::vector<std::string> device_names() {
    std::vector<std::string> names;
    names.reserve(named_devices.size());
    for (const auto& [name, kind] : named_devices) names.emplace_back(name);
    return names;
}

/// `read()`, whose failures name the option.
template <typename Read>
auto named_by(const char* option, Read&& read) {
    try {
        return read();
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}", option, error.what()));
    }
}

/// Of a server to connect to that proves nothing of itself. `usual`: its port.
void require_own_machine(const char* option, const char* why, const ListenAddress& server, int usual) {
    if (server.port == 0)
        throw std::invalid_argument(fmt::format("{}: port 0 is nowhere; {} is usual", option, usual));
    if (!is_loopback(server))
        throw std::invalid_argument(
            fmt::format("{}: {}, so it is taken from this machine alone; for {}: ssh -L {}:localhost:{} {}",
                        option, why, server.address, server.port, server.port, server.address));
}

}  // namespace

std::string name_of(DeviceKind device) {
    for (const auto& [name, kind] : named_devices)
        if (kind == device) return name;
    return {};
}

void DeviceOptions::declare(CLI::App& app) {
    app.add_option(
           "--device", device_,
           "Who moves the tool: a simulated hand, a client's mouse, a haptic arm over USB HID, a 3D "
           "mouse, whose force clients show, any arm behind a bridge (docs/device-bridge.md), a "
           "handpiece that a tracker sees and that gives no force, or Haply's Inverse3 over its local "
           "service (docs/hardware.md)")
        ->check(one_of(device_names()))
        ->capture_default_str();
    app.add_option("--device-profile", device_profile_,
                   fmt::format("Which haptic arm --device hid drives: {}, or a TOML file of your own ({})",
                               fmt::join(shipped_profile_names(), ", "), DeviceChoice{}.device_profile))
        ->type_name("NAME|FILE.toml");
    app.add_option(
           "--bridge", bridge_,
           fmt::format("Where --device bridge meets the arm's process: unix:PATH or udp:ADDRESS:PORT ({})",
                       to_text(DeviceChoice{}.bridge)))
        ->type_name("ADDRESS");
    app.add_option(
           "--bridge-key", bridge_key_,
           "With --device bridge: a secret of 32 bytes or more that the arm's side has, too; needed for one "
           "on another machine")
        ->type_name("FILE");
    app.add_option("--tracker", tracker_,
                   fmt::format("With --device tracker: the OpenIGTLink server to connect to, on this machine "
                               "({}:{}); from another take an SSH tunnel",
                               DeviceChoice{}.tracker.address, DeviceChoice{}.tracker.port))
        ->type_name("ADDRESS:PORT");
    app.add_option("--tracker-name", tracker_name_,
                   "With --device tracker: whose TRANSFORM messages move the tool (the first that comes)")
        ->type_name("NAME");
    app.add_option("--tracker-registration", tracker_registration_,
                   "With --device tracker: how the tool stands to its marker, its pedal, and three or more "
                   "points that place the tracker on the patient")
        ->type_name("FILE.toml");
    app.add_option("--haply", haply_,
                   fmt::format("With --device haply: where Haply's service listens, on this machine ({}:{})",
                               DeviceChoice{}.haply.address, DeviceChoice{}.haply.port))
        ->type_name("ADDRESS:PORT");
    app.add_flag("--list-devices", lists_devices_,
                 "Say which haptic devices are plugged in and whether they can be used, and end");
}

DeviceChoice DeviceOptions::checked() const {
    using enum DeviceKind;
    DeviceChoice choice;
    for (const auto& [name, kind] : named_devices)
        if (device_ == name) choice.device = kind;
    choice.lists_devices = lists_devices_;
    for (const auto& [option, text, kind] :
         {std::tuple("--device-profile", &device_profile_, hid), std::tuple("--bridge", &bridge_, bridge),
          std::tuple("--bridge-key", &bridge_key_, bridge), std::tuple("--tracker", &tracker_, tracker),
          std::tuple("--tracker-name", &tracker_name_, tracker),
          std::tuple("--tracker-registration", &tracker_registration_, tracker),
          std::tuple("--haply", &haply_, haply)})
        if (choice.device != kind && !text->empty())
            throw std::invalid_argument(fmt::format("{}: goes with --device {}", option, name_of(kind)));
    if (!device_profile_.empty()) choice.device_profile = device_profile_;
    check_bridge(choice);
    check_tracker(choice);
    check_haply(choice);
    return choice;
}

void DeviceOptions::check_bridge(DeviceChoice& choice) const {
    if (!bridge_.empty()) choice.bridge = named_by("--bridge", [&] { return parse_bridge_address(bridge_); });
    if (!bridge_key_.empty()) choice.bridge_key = bridge_key_;
    if (!choice.bridge_key && !is_local(choice.bridge))
        throw std::invalid_argument(
            "--bridge: an arm on another machine needs --bridge-key, so that nobody else moves the tool");
}

void DeviceOptions::check_tracker(DeviceChoice& choice) const {
    if (choice.device != DeviceKind::tracker) return;
    if (!tracker_.empty())
        choice.tracker = named_by("--tracker", [&] { return parse_listen_address(tracker_); });
    require_own_machine("--tracker", "OpenIGTLink does not say who sends", choice.tracker, 18944);
    if (tracker_name_.size() > TransformStream::longest_name)
        throw std::invalid_argument(
            fmt::format("--tracker-name: a name of OpenIGTLink has at most {} characters",
                        TransformStream::longest_name));
    choice.tracker_name = tracker_name_;
    if (tracker_registration_.empty())
        throw std::invalid_argument(
            "--device tracker: needs --tracker-registration FILE.toml, which places the tracker on the "
            "patient");
    choice.tracker_registration = tracker_registration_;
}

void DeviceOptions::check_haply(DeviceChoice& choice) const {
    if (choice.device != DeviceKind::haply) return;
    if (!haply_.empty()) choice.haply = named_by("--haply", [&] { return parse_listen_address(haply_); });
    require_own_machine("--haply", "Haply's service does not say who it is", choice.haply, 10001);
}

}  // namespace osteomill
