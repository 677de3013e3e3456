#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "common/scene/device_mapping.h"
#include "devices/tracker/tracked_tool.h"
#include "devices/tracker/transform_stream.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/session/devices/remote_arm.h"
#include "simulation/loop/clock.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

constexpr const char* server_flag = "--tracker";
constexpr const char* name_flag = "--tracker-name";
constexpr const char* registration_flag = "--tracker-registration";
const ListenAddress usual_server{.port = 18944};

struct TrackerChoice {
    ListenAddress server;
    std::string name;  ///< the name of its TRANSFORMs; empty: that of the first to come
    std::filesystem::path registration;
};

DeviceParts make_tracked_tool(const TrackerChoice& choice, const DeviceContext& context) {
    TrackerSetup setup = read_tracker_setup(choice.registration);
    context.say(residual_line(setup));
    DeviceParts parts;
    parts.mapping = setup.registration.mapping;
    const ToolPose& start = context.scene.start_pose;
    parts.device = std::make_unique<TrackedTool>(
        TrackerReceiver::Parts{
            .server = choice.server,
            .name = choice.name,
            .pedal = {},
            .now_s = [clock = std::make_shared<const RealClock>()] { return clock->now_s(); },
            .on_thread_start = [] { ask_for_real_time(device_priority); }},
        std::move(setup.handpiece),
        ToolPose{position_in_device_mm(*parts.mapping, start.position_mm),
                 direction_in_device(*parts.mapping, start.spindle_axis)});
    return parts;
}

PrepareDevice checked_tracker(const TypedOptions& typed) {
    TrackerChoice choice{.server = typed.parsed(server_flag, usual_server, parse_listen_address),
                         .name = typed.given(name_flag).value_or(""),
                         .registration = typed.given(registration_flag).value_or("")};
    require_own_machine(server_flag, "OpenIGTLink does not say who sends", choice.server, usual_server.port);
    if (choice.name.size() > IgtlStream::longest_name)
        throw std::invalid_argument(fmt::format("{}: a name of OpenIGTLink has at most {} characters",
                                                name_flag, IgtlStream::longest_name));
    if (choice.registration.empty())
        throw std::invalid_argument(
            "--device tracker: needs --tracker-registration FILE.toml, which places the tracker on the "
            "patient");
    return at_once([choice = std::move(choice)](const DeviceContext& context) {
        return make_tracked_tool(choice, context);
    });
}

}  // namespace

DeviceEntry tracker_entry() {
    return {.name = "tracker",
            .text = "a handpiece that a tracker sees and that gives no force",
            .options = {{.flag = server_flag,
                         .type_name = "ADDRESS:PORT",
                         .help = fmt::format("The OpenIGTLink server to connect to, on this machine ({}); "
                                             "from another take an SSH tunnel",
                                             to_text(usual_server))},
                        {.flag = name_flag,
                         .type_name = "NAME",
                         .help = "Whose TRANSFORM messages move the tool (the first that comes)"},
                        {.flag = registration_flag,
                         .type_name = "FILE.toml",
                         .help = "How the tool stands to its marker, its pedal, and three or more points "
                                 "that place the tracker on the patient",
                         .names_file = true}},
            // A hand that feels no force is not held: the burr is where it is.
            .coupling = CouplingKind::hold,
            .checked = checked_tracker};
}

}  // namespace osteomill
