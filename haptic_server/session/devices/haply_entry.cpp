#include <fmt/format.h>

#include "common/scene/device_mapping.h"
#include "devices/haply/haply_arm.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/devices/remote_arm.h"
#include "haptic_server/session/measured_device.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

constexpr const char* service_flag = "--haply";
const ListenAddress usual_service{.port = 10001};

DeviceParts make_haply_arm(const ListenAddress& service, const DeviceContext& context) {
    const Scene& scene = context.scene;
    auto arm = std::make_unique<HaplyArm>(
        HaplyArm::Parts{.service = service,
                        .burr_count = scene.burrs.size(),
                        .start_burr = scene.start_burr,
                        .start_axis = direction_in_device(scene.device, scene.start_pose.spindle_axis),
                        .on_thread_start = [] { ask_for_real_time(device_priority); }});
    context.say(fmt::format("waiting for an Inverse3 of the Haply service at {}", to_text(service)));
    if (!has_come(*arm, context)) return {};
    context.say(
        fmt::format("Haply Inverse3 is there: {:.2f} ms from a reading to its force, with which {:.3g} "
                    "N/mm hold",
                    1000.0 * arm->delay_s(), arm->limits().max_stiffness_n_per_mm));
    DeviceParts parts;
    parts.home_mm = arm->workspace_middle_mm();
    parts.delay_s = arm->delay_s();
    parts.device = std::move(arm);
    return parts;
}

PrepareDevice checked_haply(const TypedOptions& typed) {
    const ListenAddress service = typed.parsed(service_flag, usual_service, parse_listen_address);
    require_own_machine(service_flag, "Haply's service does not say who it is", service, usual_service.port);
    return [service, load = typed_measured_profile(typed)]() -> MakeDevice {
        return [service, profile = load()](const DeviceContext& context) {
            return with_measured(make_haply_arm(service, context), profile, context);
        };
    };
}

}  // namespace

DeviceEntry haply_entry() {
    return {.name = "haply",
            .text = "Haply's Inverse3 over its local service (docs/hardware.md)",
            .options = {{.flag = service_flag,
                         .type_name = "ADDRESS:PORT",
                         .help = fmt::format("Where Haply's service listens, on this machine ({})",
                                             to_text(usual_service))},
                        measured_profile_option()},
            .is_arm = true,
            .checked = checked_haply};
}

}  // namespace osteomill
