#include "haptic_server/program/server_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/surface/mesh_file.h"
#include "common/files/distinct_files.h"
#include "common/program/command_options.h"
#include "haptic_server/program/session_outputs.h"
#include "haptic_server/program/typed_server_options.h"
#include "haptic_server/session/measured_device.h"
#include "haptic_server/session/session_defaults.h"
#include "imaging/case/case_folder.h"

namespace osteomill {

void DeviceOptions::declare(CommandOptions& app) {
    std::vector<std::string> names;
    std::string help = "Who moves the tool:";
    for (const DeviceEntry& entry : devices()) {
        names.emplace_back(entry.name);
        help += fmt::format("\n  {}: {}", entry.name, entry.text);
    }
    app.add_option("--device", device_, help).check(one_of(names)).shows_default();
    std::map<std::string, CommandOption> declared;  // several devices may share one
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options) {
            const std::string text = fmt::format("With --device {}: {}", entry.name, option.help);
            if (const auto found = declared.find(option.flag); found != declared.end())
                found->second.add_help(text);
            else
                declared.emplace(
                    option.flag,
                    app.add_option(option.flag, texts_[option.flag], text).type_name(option.type_name));
        }
    app.add_flag("--list-devices", lists_devices_,
                 "Say which haptic devices are plugged in and whether they can be used, and end");
}

DeviceChoice DeviceOptions::checked() const {
    DeviceChoice choice;
    choice.lists_devices = lists_devices_;
    choice.entry = &find_device(device_);
    std::map<std::string, std::string> typed;
    for (const DeviceOption& option : choice.entry->options) {
        const std::string& text = texts_.at(option.flag);
        if (text.empty()) continue;
        if (option.names_file)
            choice.files_read.push_back({.option = option.flag,
                                         .path = text,
                                         .is_written = false,
                                         .is_replaced_by = option.is_replaced_by});
        typed[option.flag] = text;
    }
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options)
            // Not for this device.
            if (!texts_.at(option.flag).empty() && !typed.contains(option.flag))
                throw std::invalid_argument(
                    fmt::format("{}: goes with --device {}", option.flag, entry.name));
    choice.prepare = choice.entry->checked(TypedOptions(std::move(typed)));
    return choice;
}

namespace {

std::optional<ListenAddress> listen_address(const TypedServerOptions& typed) {
    if (typed.listen == "none" || (typed.listen.empty() && typed.clock == "virtual")) return std::nullopt;
    if (typed.listen.empty()) return ListenAddress{};
    return parse_listen_address(typed.listen);
}

CouplingChoice coupling_of(const TypedServerOptions& typed, const DeviceEntry& device) {
    const std::string& force_model = typed.options.milling.force_model;
    const bool has_cutting_law = find_force_model(force_model).has_cutting_law;
    if (!typed.coupling) return usual_coupling(has_cutting_law, device);
    const CouplingChoice choice =
        said_of_option("--coupling", [&] { return coupling_named(*typed.coupling); });
    const std::string both = fmt::format("--coupling {}, --force-model {}", *typed.coupling, force_model);
    said_of_option(both.c_str(), [&] { require_cutting_law(choice, has_cutting_law); });
    return choice;
}

SceneChanges scene_changes(const TypedServerOptions& typed) {
    SceneChanges changes{.option = typed.changes.empty() ? "--burr" : "--set"};
    for (const std::string& text : typed.changes)
        changes.changes.push_back(said_of_option("--set", [&] { return parse_scene_change(text); }));
    if (!typed.burr.empty())
        changes.changes.push_back({.key = "start_burr", .value = typed.burr, .is_text = true});
    return changes;
}

void require_cutting_law_to_vibrate(const MillingSessionOptions& session) {
    if (session.vibration && !find_force_model(session.force_model).has_cutting_law)
        throw std::invalid_argument(fmt::format(
            "--vibration: comes of the cutting law, and --force-model {} has none", session.force_model));
}

bool is_utf8(const std::string& text) {
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::type_error&) {
        return false;
    }
}

/// NAME.histograms.json of NAME.json; nowhere if that is no file, such as /dev/stdout.
std::optional<std::filesystem::path> histograms_beside(const std::filesystem::path& json) {
    std::error_code unknown;
    if (std::filesystem::exists(json, unknown) && !std::filesystem::is_regular_file(json, unknown))
        return std::nullopt;
    return json.parent_path() / (json.stem().string() + ".histograms.json");
}

void require_trainee(const std::string& name) {
    constexpr std::size_t longest = 100;
    const bool has_control = std::any_of(name.begin(), name.end(), [](char letter) {
        return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
    });
    if (name.size() > longest || has_control || !is_utf8(name))
        throw std::invalid_argument(
            fmt::format("--trainee: a name is one line of at most {} bytes of UTF-8", longest));
}

/// All that the command line names. A bone may be saved over the one of --bone, which it continues: that is
/// replaced when all of the new one is there.
std::vector<NamedFile> files_of(const ServerOptions& options, const AccessOptions& access) {
    constexpr std::array placement_names{"placement.toml"};
    constexpr std::array report_names{"report.html", "metrics.csv", "metrics.json", "session*.pcap"};
    const OutputFiles& outputs = options.outputs;
    std::vector<NamedFile> files = access.files_read();
    files.insert(files.end(), options.device.files_read.begin(), options.device.files_read.end());
    const auto add = [&files](const char* option, const std::optional<std::filesystem::path>& path,
                              bool is_written) {
        if (path) files.push_back({option, *path, is_written});
    };
    const auto add_in = [&files](const char* option, const std::filesystem::path& folder,
                                 std::span<const char* const> names) {
        const std::vector<NamedFile> written = files_written_in(option, folder, names);
        files.insert(files.end(), written.begin(), written.end());
    };
    add("--trajectory", options.scene.trajectory, false);
    if (outputs.case_folder) {
        for (const auto& file : files_of_case(*outputs.case_folder)) add("--case", file, false);
        add_in("--case", *outputs.case_folder, placement_names);
    } else {
        add("--scene", options.scene.name, false);
    }
    if (options.scene.bone)
        files.push_back({.option = "--bone",
                         .path = *options.scene.bone,
                         .is_written = false,
                         .is_replaced_by = "--save-bone"});
    add("--operators", options.operators, false);
    add("--controls", options.controls, false);
    add("--json", outputs.json, true);
    add("--json (its histograms)", outputs.json_histograms, true);
    if (outputs.report) add_in("--report", *outputs.report, report_names);
    add("--log-csv", options.logs.force, true);
    add("--log-milling-csv", options.logs.milling, true);
    if (!outputs.report) add("--record", options.record, true);
    add("--save-bone", outputs.save_bone, true);
    add(save_profile_flag, options.measures_into, true);
    if (outputs.save_bone)
        for (const char* const ending : mesh_ending_list)
            add("--save-bone (a surface)",
                std::filesystem::path(*outputs.save_bone).replace_extension(ending), true);
    return files;
}

std::optional<ListenAddress> metrics_address(const TypedServerOptions& typed) {
    if (typed.metrics.empty()) return std::nullopt;
    const ListenAddress where =
        said_of_option("--metrics", [&] { return parse_listen_address(typed.metrics); });
    if (!is_loopback(where))
        throw std::invalid_argument(
            fmt::format("--metrics: '{}' can be reached from elsewhere; take "
                        "127.0.0.1:{}",
                        typed.metrics, where.port));
    return where;
}

void require_host_names(const TypedServerOptions& typed) {
    const std::vector<std::string>& names = typed.options.metrics_hosts;
    if (!names.empty() && typed.metrics.empty())
        throw std::invalid_argument("--metrics-host is of no use without --metrics");
    for (const std::string& name : names)
        if (name.empty() || name.find_first_of(":/[] ") != std::string::npos)
            throw std::invalid_argument(fmt::format(
                "--metrics-host: '{}' is no host name; take one without port and path, such as monitor.lab",
                name));
}

/// A measurement runs no session, so nothing of one is written.
void require_nothing_of_a_session(const std::vector<NamedFile>& files) {
    for (const NamedFile& file : files)
        if (file.is_written && file.option != save_profile_flag)
            throw std::invalid_argument(fmt::format(
                "{} is of no use with --measure-arm, which runs no session; leave one out", file.option));
}

/// The profile to write; nothing if no arm is measured.
std::optional<std::filesystem::path> measured_profile(const TypedServerOptions& typed,
                                                      const DeviceEntry& device) {
    if (!typed.measures_arm && !typed.save_profile.empty())
        throw std::invalid_argument(fmt::format("{} is of no use without --measure-arm", save_profile_flag));
    if (!typed.measures_arm) return std::nullopt;
    if (!device.is_arm)
        throw std::invalid_argument(fmt::format(
            "--measure-arm: --device {} is no arm; take hid, bridge, haply or simulated", device.name));
    if (typed.grip == rails_name)
        throw std::invalid_argument(fmt::format(
            "--measure-arm: a prescribed hand (--grip {}) feels no force; take light or firm", rails_name));
    if (typed.options.scene.trajectory)
        throw std::invalid_argument(
            "--measure-arm: the hand holds the arm at one place; leave --trajectory out");
    const std::filesystem::path file =
        typed.save_profile.empty() ? usual_measured_profile : typed.save_profile;
    if (file.extension() != ".toml")
        throw std::invalid_argument(
            fmt::format("{}: '{}' must end in .toml", save_profile_flag, file.string()));
    return file;
}

ServerOptions checked(const TypedServerOptions& typed, const AccessOptions& access) {
    const bool is_virtual = typed.clock == "virtual";
    ServerOptions options = typed.options;
    OutputFiles& outputs = options.outputs;
    options.device = typed.device.checked();
    const DeviceEntry& device = *options.device.entry;
    const bool is_client = device.is_moved_by_client;
    if (!device.is_simulated && is_virtual) {
        throw std::invalid_argument(fmt::format("--device {}: a person needs --clock real", device.name));
    }
    if (!device.is_simulated && options.scene.trajectory) {
        throw std::invalid_argument("--trajectory: only --device simulated follows one");
    }
    if (!typed.case_name.empty()) {
        const SceneChoice of_case = case_chosen(typed.case_name);
        options.scene.name = of_case.name;
        options.scene.case_folder = outputs.case_folder = of_case.case_folder;
        options.case_name = name_of_case(typed.case_name);
    }
    options.scene.changes = scene_changes(typed);
    if (options.scene.bone && !options.scene.name && !options.scene.changes.changes.empty())
        throw std::invalid_argument(fmt::format(
            "{}: of a scene; --bone alone has none, name one with --scene", options.scene.changes.option));
    options.grip = typed.grip == "light" ? Grip::light : Grip::firm;
    if (typed.grip == rails_name) options.grip.reset();
    if (!options.grip && !device.is_simulated)
        throw std::invalid_argument(fmt::format("--grip {}: goes with --device simulated", rails_name));
    options.milling.clock = is_virtual ? ClockKind::virtual_time : ClockKind::real;
    options.milling.coupling = coupling_of(typed, device);
    require_cutting_law_to_vibrate(options.milling);
    options.milling.milling_rate_hz =
        typed.milling_rate_hz > 0.0
            ? typed.milling_rate_hz
            : usual_milling_rate_hz(options.milling.coupling, options.milling.force_model);
    options.listen = said_of_option("--listen", [&] { return listen_address(typed); });
    if (options.listen) options.access = access.access_to(*options.listen);
    options.metrics = metrics_address(typed);
    require_host_names(typed);
    if (is_client && !options.listen) {
        throw std::invalid_argument("--device client: the operator connects over --listen, which is none");
    }
    if (options.waits_for_client && (is_virtual || !options.listen))
        throw std::invalid_argument("--wait-for-client: needs --clock real and --listen, where one connects");
    if (options.operators && !is_client)
        throw std::invalid_argument(
            "--operators: goes with --device client; with others no client moves the tool");
    if (options.operators && !options.access.tls)
        throw std::invalid_argument(
            "--operators: needs TLS (--tls-cert, --tls-key, --tls-ca), which says who a client is");
    if (outputs.report && options.record)
        throw std::invalid_argument("--record: --report records already, as DIR/session.pcap");
    if (outputs.report) options.record = recording_in(*outputs.report);
    options.records_ticks = typed.record_rate_hz == "1000";
    require_trainee(options.trainee);
    if (outputs.save_bone && outputs.save_bone->extension() != ".nrrd") {
        throw std::invalid_argument(
            fmt::format("--save-bone: '{}' must end in .nrrd", outputs.save_bone->string()));
    }
    options.measures_into = measured_profile(typed, device);
    if (outputs.json) outputs.json_histograms = histograms_beside(*outputs.json);
    options.files = files_of(options, access);
    if (options.measures_into) require_nothing_of_a_session(options.files);
    if (options.measures_into && options.waits_for_client)
        throw std::invalid_argument(
            "--wait-for-client is of no use with --measure-arm, which runs no session");
    require_distinct(options.files);
    return options;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version) {
    TypedServerOptions typed;
    CommandOptions app(
        "Owns the bone, mills it at up to 10 kHz, feeds forces to the hand and shows clients the rest.",
        "haptic_server", fmt::format("haptic_server {}", version));
    declare(app, typed);
    const AccessOptions access(app);
    if (auto text = app.parse_or_text(argc, argv)) return {std::nullopt, *std::move(text)};
    return {checked(typed, access), {}};
}

}  // namespace osteomill
