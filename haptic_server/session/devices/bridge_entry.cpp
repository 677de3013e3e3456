#include <fmt/format.h>

#include <random>
#include <stdexcept>

#include "bridge/osteomill_bridge.h"
#include "common/files/input_file.h"
#include "common/scene/device_mapping.h"
#include "devices/bridge/bridge_arm.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/devices/remote_arm.h"
#include "haptic_server/session/measured_device.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

constexpr const char* address_flag = "--bridge";
constexpr const char* key_flag = "--bridge-key";
const BridgeAddress usual_bridge = ListenAddress{.port = 7020};

omb_key read_key(const std::filesystem::path& path) {
    const std::string secret = read_secret(path, bridge_key_kind);
    if (secret.size() < 32)
        throw std::runtime_error(fmt::format("{}: a key of the bridge has 32 to {} bytes, this has {}",
                                             path.string(), bridge_key_kind.most_bytes, secret.size()));
    omb_key key;
    omb_set_key(&key, reinterpret_cast<const std::uint8_t*>(secret.data()), secret.size());
    return key;
}

std::uint64_t random_number() {
    std::random_device random;
    return (std::uint64_t{random()} << 32U) | random();
}

DeviceParts make_bridge_arm(const BridgeAddress& address, const omb_key& key, const DeviceContext& context) {
    const Scene& scene = context.scene;
    BridgeArm::Parts bridge{.burr_count = scene.burrs.size(),
                            .start_burr = scene.start_burr,
                            .start_axis = direction_in_device(scene.device, scene.start_pose.spindle_axis),
                            .random = random_number,
                            .on_thread_start = [] { ask_for_real_time(device_priority); }};
    bridge.key = key;
    auto arm = std::make_unique<BridgeArm>(address, std::move(bridge));
    context.say(fmt::format("waiting for an arm at {}", to_text(arm->address())));
    if (!has_come(*arm, context)) return {};
    const DeviceLimits limits = arm->limits();
    context.say(fmt::format(
        "arm {} has joined: {:.3g} N, {:.3g} g; {:.2f} ms there and back, with which {:.3g} N/mm hold",
        arm->name(), limits.max_force_n, 1000.0 * limits.apparent_mass_kg, 1000.0 * arm->round_trip_s(),
        limits.max_stiffness_n_per_mm));
    DeviceParts parts;
    parts.home_mm = arm->workspace_middle_mm();
    parts.delay_s = arm->round_trip_s();
    parts.device = std::move(arm);
    return parts;
}

PrepareDevice checked_bridge(const TypedOptions& typed) {
    const BridgeAddress address = typed.parsed(address_flag, usual_bridge, parse_bridge_address);
    const std::optional<std::string> key_file = typed.given(key_flag);
    if (!key_file && !is_local(address))
        throw std::invalid_argument(
            "--bridge: an arm on another machine needs --bridge-key, so that nobody else moves the tool");
    return [address, key_file, load = typed_measured_profile(typed)]() -> MakeDevice {
        return [address, key = key_file ? read_key(*key_file) : omb_key{},
                profile = load()](const DeviceContext& context) {
            return with_measured(make_bridge_arm(address, key, context), profile, context);
        };
    };
}

}  // namespace

DeviceEntry bridge_entry() {
    return {.name = "bridge",
            .text = "any arm behind a bridge (docs/device-bridge.md)",
            .options = {{.flag = address_flag,
                         .type_name = "ADDRESS",
                         .help = fmt::format("Where it meets the arm's process: unix:PATH or "
                                             "udp:ADDRESS:PORT ({})",
                                             to_text(usual_bridge))},
                        {.flag = key_flag,
                         .type_name = "FILE",
                         .help = "A secret of 32 bytes or more that the arm's side has, too; needed for one "
                                 "on another machine"},
                        measured_profile_option()},
            .is_arm = true,
            .checked = checked_bridge};
}

}  // namespace osteomill
