#include "haptic_server/program/device_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/files/input_file.h"
#include "common/scene/device_mapping.h"
#include "devices/bridge/bridge_arm.h"
#include "devices/client/client_device.h"
#include "devices/haply/haply_arm.h"
#include "devices/hid/hid_arm.h"
#include "devices/hid/hidapi_transport.h"
#include "devices/hid/profile_file.h"
#include "devices/hid/space_mouse.h"
#include "devices/simulated/arm_model.h"
#include "devices/simulated/hand_model.h"
#include "devices/simulated/trajectory.h"
#include "devices/tracker/tracked_tool.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/real_time.h"
#include "simulation/loop/thread_priority.h"

namespace osteomill {

namespace {

DeviceParts make_haptic_arm(const ServerOptions& options, Scene& scene) {
    const ArmProfile profile = load_arm_profile(options.device_profile);
    // A scene that does not say how the arm sits on the patient: its calibration position is the start.
    if (scene.device == DeviceMapping{})
        scene.device.offset_mm = scene.start_pose.position_mm - home_position_mm(profile);
    DeviceParts parts;
    parts.transport = std::make_unique<HidapiTransport>();
    parts.device = std::make_unique<HidArm>(
        profile, *parts.transport, [clock = RealClock()] { return clock.now_s(); },
        [] { ask_for_real_time(device_priority); });
    return parts;
}

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

/// Waits for an arm, and says in `out` what it says. False: `stop` came first.
template <typename Arm>
bool has_come(Arm& arm, const std::atomic<bool>& stop, LineStream& out) {
    std::string said;
    return arm.await([&] {
        const std::string notice = arm.notice();
        if (notice != said && !notice.empty()) out.say(notice);
        said = notice;
        return stop.load();
    });
}

DeviceParts make_bridge_arm(const ServerOptions& options, const omb_key& key, Scene& scene,
                            const std::atomic<bool>& stop, LineStream& out) {
    BridgeArm::Parts bridge{.burr_count = scene.burrs.size(),
                            .start_burr = scene.start_burr,
                            .start_axis = direction_in_device(scene.device, scene.start_pose.spindle_axis),
                            .random = random_number,
                            .on_thread_start = [] { ask_for_real_time(device_priority); }};
    bridge.key = key;
    auto arm = std::make_unique<BridgeArm>(options.bridge, std::move(bridge));
    out.say(fmt::format("waiting for an arm at {}", to_text(arm->address())));
    if (!has_come(*arm, stop, out)) return {};
    const DeviceLimits limits = arm->limits();
    out.say(fmt::format(
        "arm {} has joined: {:.3g} N, {:.3g} g; {:.2f} ms there and back, with which {:.3g} N/mm hold",
        arm->name(), limits.max_force_n, 1000.0 * limits.apparent_mass_kg, 1000.0 * arm->round_trip_s(),
        limits.max_stiffness_n_per_mm));
    // A scene that does not say how the arm sits on the patient: the middle of its workspace is the start.
    if (scene.device == DeviceMapping{})
        scene.device.offset_mm = scene.start_pose.position_mm - arm->workspace_middle_mm();
    DeviceParts parts;
    parts.device = std::move(arm);
    return parts;
}

DeviceParts make_haply_arm(const ServerOptions& options, Scene& scene, const std::atomic<bool>& stop,
                           LineStream& out) {
    auto arm = std::make_unique<HaplyArm>(
        HaplyLinkParts{.service = options.haply,
                       .burr_count = scene.burrs.size(),
                       .start_burr = scene.start_burr,
                       .start_axis = direction_in_device(scene.device, scene.start_pose.spindle_axis),
                       .on_thread_start = [] { ask_for_real_time(device_priority); }});
    out.say(fmt::format("waiting for an Inverse3 of the Haply service at {}", to_text(options.haply)));
    if (!has_come(*arm, stop, out)) return {};
    out.say(
        fmt::format("Haply Inverse3 is there: {:.2f} ms from a reading to its force, with which {:.3g} "
                    "N/mm hold",
                    1000.0 * arm->delay_s(), arm->limits().max_stiffness_n_per_mm));
    // A scene that does not say how the arm sits on the patient: the middle of its workspace is the start.
    if (scene.device == DeviceMapping{})
        scene.device.offset_mm = scene.start_pose.position_mm - arm->workspace_middle_mm();
    DeviceParts parts;
    parts.device = std::move(arm);
    return parts;
}

DeviceParts make_tracked_tool(const ServerOptions& options, Scene& scene, LineStream& out) {
    TrackerSetup setup = read_tracker_setup(options.tracker_registration);
    out.say(residual_line(setup));
    scene.device = setup.registration.mapping;
    DeviceParts parts;
    parts.device = std::make_unique<TrackedTool>(
        TrackerReceiver::Parts{.server = options.tracker,
                               .name = options.tracker_name,
                               .pedal = {},
                               .now_s = [clock = RealClock()] { return clock.now_s(); },
                               .on_thread_start = [] { ask_for_real_time(device_priority); }},
        std::move(setup.handpiece),
        ToolPose{position_in_device_mm(scene.device, scene.start_pose.position_mm),
                 direction_in_device(scene.device, scene.start_pose.spindle_axis)});
    return parts;
}

}  // namespace

omb_key read_bridge_key(const ServerOptions& options) {
    return options.bridge_key ? read_key(*options.bridge_key) : omb_key{};
}

DeviceParts make_device(const ServerOptions& options, const omb_key& bridge_key, Scene& scene,
                        const std::atomic<bool>& stop, LineStream& out) {
    if (options.device == DeviceKind::hid) return make_haptic_arm(options, scene);
    if (options.device == DeviceKind::bridge) return make_bridge_arm(options, bridge_key, scene, stop, out);
    if (options.device == DeviceKind::haply) return make_haply_arm(options, scene, stop, out);
    if (options.device == DeviceKind::tracker) return make_tracked_tool(options, scene, out);
    const HandModel hand = hand_model(options.grip);
    DeviceParts parts;
    if (options.device == DeviceKind::space_mouse) {
        parts.transport = std::make_unique<HidapiTransport>();
        parts.device = std::make_unique<SpaceMouse>(
            scene, ArmModel{}, hand, *parts.transport, [clock = RealClock()] { return clock.now_s(); },
            [] { ask_for_real_time(device_priority); });
        return parts;
    }
    if (options.device == DeviceKind::client) {
        parts.operator_channel = std::make_unique<OperatorChannel>();
        parts.device = std::make_unique<ClientDevice>(*parts.operator_channel, scene.start_pose, scene.device,
                                                      ArmModel{}, hand);
        return parts;
    }
    Trajectory trajectory =
        make_trajectory(scene.trajectory, scene.start_pose, scene.burrs, scene.start_burr);
    const bool would_never_end =
        std::isinf(trajectory.duration_s()) && std::isinf(options.session.duration_s);
    if (options.session.clock == ClockKind::virtual_time && would_never_end) {
        throw std::runtime_error("--clock virtual: the trajectory never ends; give --duration-s");
    }
    auto simulated = std::make_unique<SimulatedDevice>(std::move(trajectory), scene.device, ArmModel{}, hand);
    parts.simulated = simulated.get();
    parts.device = std::move(simulated);
    return parts;
}

}  // namespace osteomill
