#include "haptic_server/program/server_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/scene/phantom_names.h"
#include "common/scene/session_control.h"
#include "haptic_server/program/report_folder.h"
#include "haptic_server/session/session_defaults.h"
#include "imaging/case/case_folder.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill {

namespace {

/// As typed, before it is checked against each other.
struct Typed {
    std::string scene;
    std::string case_name;
    std::string bone;
    std::vector<std::string> changes;
    std::string burr;
    double spindle_rpm = 0.0;
    DeviceOptions device;
    std::string grip = "firm";
    std::string trajectory;
    std::string coupling;
    std::string force_model = force_model_names().front();
    double milling_rate_hz = 0.0;
    bool vibration = false;
    std::string clock = "real";
    int haptic_cpu = -1;
    int milling_cpu = -1;
    double duration_s = std::numeric_limits<double>::infinity();
    std::string listen;
    std::string metrics;
    bool log_json = false;
    std::string operators;
    std::string controls;
    std::string record;
    std::string record_rate_hz = "1000";
    std::string save_bone;
    std::string json;
    std::string report;
    std::string trainee;
    std::string log_csv;
    std::string log_milling_csv;
    bool check = false;
};

CLI::Validator a_coupling() {
    return CLI::Validator(
        [](std::string& value) {
            try {
                (void)find_coupling(value);
                return std::string();
            } catch (const std::invalid_argument& error) {
                return std::string(error.what());
            }
        },
        "");
}

/// A line for each.
std::string force_model_help() {
    std::string text = "How bone pushes back:";
    for (const ForceModelEntry& model : force_models())
        text += fmt::format("\n  {}: {}", model.name, model.text);
    return text;
}

std::string coupling_help() {
    std::string text = fmt::format(
        "What stands between the model and the hand ({}; {} with a force model that has no cutting law",
        usual_coupling(true, devices().front()), usual_coupling(false, devices().front()));
    for (const DeviceEntry& device : devices())
        if (device.coupling != nullptr)
            text += fmt::format("; {} with --device {}", device.coupling, device.name);
    text += "):";
    for (const CouplingEntry& coupling : couplings())
        text += fmt::format("\n  {}: {}", coupling.name, coupling.text);
    return text +
           "\n  BASE+damper, BASE+passivity: the same with another BASE of those that hold or interpolate";
}

void declare(CLI::App& app, Typed& typed) {
    app.add_option(
           "--scene", typed.scene,
           fmt::format(
               "Scene: a TOML file, or a phantom: {} (tooth; with --bone alone: a cavity on top of that "
               "bone)",
               fmt::join(phantom_names, ", ")))
        ->capture_default_str();
    app.add_option("--case", typed.case_name,
                   fmt::format("Case: a folder that bone_import --case made, or one built in: {}",
                               fmt::join(phantom_names, ", ")))
        ->type_name("DIR|NAME")
        ->excludes("--scene");
    app.add_option("--bone", typed.bone, "Bone from a file that bone_import wrote, instead of the scene's")
        ->type_name("FILE.nrrd");
    add_texts(app, "--set", typed.changes,
              "A key of the scene, whatever its file says, such as wall_friction=0.3, device.scale=0.5 or "
              "tissues.enamel.cuttable=false (docs/scenes.md); again for each further one")
        ->type_name("KEY=VALUE");
    app.add_option("--burr", typed.burr, "The burr to start with, by its name in the scene")
        ->type_name("NAME");
    app.add_option("--rpm", typed.spindle_rpm, "Spindle speed of every burr, in place of the scene's")
        ->check(within(least_spindle_rpm, most_spindle_rpm));
    typed.device.declare(app);
    app.add_option(
           "--grip", typed.grip,
           "How the simulated hand holds the arm; on rails it is where the trajectory has it, whatever the "
           "force")
        ->check(one_of({"light", "firm", rails_name}))
        ->capture_default_str();
    app.add_option("--trajectory", typed.trajectory,
                   "What the simulated hand follows, instead of the scene's")
        ->type_name("FILE.csv");
    app.add_option("--coupling", typed.coupling, coupling_help())->check(a_coupling())->type_name("NAME");
    app.add_option("--force-model", typed.force_model, force_model_help())
        ->check(one_of(force_model_names()))
        ->capture_default_str();
    app.add_option("--milling-rate-hz", typed.milling_rate_hz,
                   fmt::format("Steps of the milling loop per second, {:.0f} to {:.0f} (1000; 100 where the "
                               "milling force is interpolated, as published)",
                               least_milling_rate_hz, most_milling_rate_hz))
        ->check(within(least_milling_rate_hz, most_milling_rate_hz));
    app.add_flag(
        "--vibration", typed.vibration,
        "Add what the arm can render of the handpiece's vibration, up to 300 Hz: run-out, once a turn of "
        "the spindle (to 18 000 rpm), and the edges' passing");
    app.add_option("--clock", typed.clock, "real, or virtual: as fast as it can, repeatable to the bit")
        ->check(one_of({"real", "virtual"}))
        ->capture_default_str();
    app.add_option("--haptic-cpu", typed.haptic_cpu,
                   "Bind the haptic loop to this processor; best one that the kernel keeps free (isolcpus)")
        ->check(not_below_zero());
    app.add_option("--milling-cpu", typed.milling_cpu, "Bind the milling loop to this processor")
        ->check(not_below_zero());
    app.add_option("--duration-s", typed.duration_s, "Stop after this long (or at the trajectory's end)")
        ->check(above_zero());
    app.add_option("--listen", typed.listen,
                   "Where clients connect, port 0: any free one; \"none\": nobody does (127.0.0.1:7010; none "
                   "with --clock virtual)")
        ->type_name("ADDRESS:PORT");
    app.add_option("--metrics", typed.metrics,
                   "Where Prometheus or curl may ask how the session goes, at /metrics; an address of this "
                   "machine alone, such as 127.0.0.1:9464")
        ->type_name("ADDRESS:PORT");
    app.add_flag("--log-json", typed.log_json,
                 "Standard error, with the log, as one JSON object a line: time, level, message");
    app.add_option("--operators", typed.operators,
                   "With --device client and TLS: who may move the tool, others watch; a certificate's "
                   "subject a line, "
                   "whole, as RFC 2253 writes it, such as CN=viewer; # begins a comment")
        ->type_name("FILE");
    app.add_option("--controls", typed.controls,
                   "Pause, undo, mark and the like at given times, as the window's tool bar does; lines of "
                   "t_s,action,text")
        ->type_name("FILE.csv");
    app.add_option("--record", typed.record,
                   "Write what a client is sent, for packet_replay and render_client --replay; a pcap file")
        ->type_name("FILE");
    app.add_option("--record-rate-hz", typed.record_rate_hz,
                   "What a recording holds: 1000, every tick of the haptic loop (packet_replay --csv is then "
                   "the log of --log-csv), or 30, only the states that clients are sent")
        ->check(one_of({"1000", "30"}))
        ->capture_default_str();
    app.add_option("--save-bone", typed.save_bone,
                   "Write what is left of the bone, at the end or on a signal; a large CT takes a minute and "
                   "says how "
                   "far it has come")
        ->type_name("FILE.nrrd");
    app.add_option(
           "--report", typed.report,
           "Record the session into this folder and, at its end, write its report: report.html, metrics.csv, "
           "metrics.json; a folder that holds a session already is refused")
        ->type_name("DIR");
    app.add_option("--trainee", typed.trainee, "Whose session it is, for the recording and the report")
        ->type_name("NAME");
    app.add_option("--json", typed.json,
                   "Write what was measured, and with which settings; the histograms that its percentiles "
                   "are from go beside it, into NAME.histograms.json")
        ->type_name("FILE");
    app.add_option("--log-csv", typed.log_csv, "Write force and depth, a line a millisecond")
        ->type_name("FILE");
    app.add_option(
           "--log-milling-csv", typed.log_milling_csv,
           "Write the milling force of every milling step; with --force-model milling-instants at 10 kHz, "
           "the force within the tooth period")
        ->type_name("FILE");
    app.add_flag(
        "--check", typed.check,
        "Look whether the machine is ready for a session with these options, say for all that is not "
        "what it costs and what mends it, and end: 0 where nothing is wrong, else 1");
}

std::optional<std::filesystem::path> path_if_given(const std::string& text) {
    if (text.empty()) return std::nullopt;
    return text;
}

std::optional<ListenAddress> listen_address(const Typed& typed) {
    if (typed.listen == "none" || (typed.listen.empty() && typed.clock == "virtual")) return std::nullopt;
    if (typed.listen.empty()) return ListenAddress{};
    return parse_listen_address(typed.listen);
}

std::string checked_coupling(const Typed& typed, const DeviceEntry& device) {
    const bool has_cutting_law = find_force_model(typed.force_model).has_cutting_law;
    if (typed.coupling.empty()) return usual_coupling(has_cutting_law, device);
    if (find_coupling(typed.coupling).needs_cutting_law && !has_cutting_law) {
        throw std::invalid_argument(
            fmt::format("--coupling {}: solves the cutting law, and --force-model {} has none; take "
                        "--coupling {}",
                        typed.coupling, typed.force_model, usual_coupling(has_cutting_law, device)));
    }
    return typed.coupling;
}

SceneChanges scene_changes(const Typed& typed) {
    SceneChanges changes{.option = typed.changes.empty() ? "--burr" : "--set"};
    try {
        for (const std::string& text : typed.changes) changes.changes.push_back(parse_scene_change(text));
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("--set: {}", error.what()));
    }
    if (!typed.burr.empty())
        changes.changes.push_back({.key = "start_burr", .value = typed.burr, .is_text = true});
    return changes;
}

bool checked_vibration(const Typed& typed) {
    if (typed.vibration && !find_force_model(typed.force_model).has_cutting_law)
        throw std::invalid_argument(fmt::format(
            "--vibration: comes of the cutting law, and --force-model {} has none", typed.force_model));
    return typed.vibration;
}

bool is_utf8(const std::string& text) {
    try {
        (void)nlohmann::json(text).dump();
        return true;
    } catch (const nlohmann::json::type_error&) {
        return false;
    }
}

/// NAME.histograms.json of NAME.json; nowhere for what is no file, such as /dev/stdout.
std::optional<std::filesystem::path> histograms_beside(const std::filesystem::path& json) {
    std::error_code unknown;
    if (std::filesystem::exists(json, unknown) && !std::filesystem::is_regular_file(json, unknown))
        return std::nullopt;
    return json.parent_path() / (json.stem().string() + ".histograms.json");
}

std::string checked_trainee(const std::string& name) {
    constexpr std::size_t longest = 100;
    const bool has_control = std::any_of(name.begin(), name.end(), [](char letter) {
        return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
    });
    if (name.size() > longest || has_control || !is_utf8(name))
        throw std::invalid_argument(
            fmt::format("--trainee: a name is one line of at most {} bytes of UTF-8", longest));
    return name;
}

/// A bone may be saved over the one that was loaded: it is replaced when all of the new one is there.
void require_distinct_files(const ServerOptions& options, const AccessOptions& access) {
    const OutputFiles& outputs = options.outputs;
    std::vector<NamedFile> files = access.files_read();
    files.insert(files.end(), options.device.files_read.begin(), options.device.files_read.end());
    const auto add = [&files](const char* option, const std::optional<std::filesystem::path>& path,
                              bool is_written) {
        if (path) files.push_back({option, *path, is_written});
    };
    add("--trajectory", options.scene.trajectory, false);
    if (options.scene.name) add("--scene", *options.scene.name, false);
    add("--operators", options.operators, false);
    add("--controls", options.controls, false);
    add("--json", outputs.json, true);
    add("--json (its histograms)", outputs.json_histograms, true);
    if (outputs.report)
        for (const char* name : {"report.html", "metrics.csv", "metrics.json"})
            add("--report", *outputs.report / name, true);
    add("--log-csv", options.logs.force, true);
    add("--log-milling-csv", options.logs.milling, true);
    add(outputs.report ? "--report" : "--record", options.record, true);
    const std::size_t without_bones = files.size();
    for (const bool saved : {false, true}) {
        files.resize(without_bones);
        saved ? add("--save-bone", outputs.save_bone, true) : add("--bone", options.scene.bone, false);
        require_distinct(files);
    }
}

std::optional<ListenAddress> metrics_address(const Typed& typed) {
    if (typed.metrics.empty()) return std::nullopt;
    try {
        const ListenAddress where = parse_listen_address(typed.metrics);
        if (!is_loopback(where))
            throw std::invalid_argument(fmt::format("'{}' can be reached from elsewhere; take 127.0.0.1:{}",
                                                    typed.metrics, where.port));
        return where;
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("--metrics: {}", error.what()));
    }
}

ServerOptions checked(const Typed& typed, const AccessOptions& access) {
    const bool is_virtual = typed.clock == "virtual";
    ServerOptions options;
    options.device = typed.device.checked();
    const DeviceEntry& device = *options.device.entry;
    const bool is_client = device.is_moved_by_client;
    if (!device.is_simulated && is_virtual) {
        throw std::invalid_argument(fmt::format("--device {}: a person needs --clock real", device.name));
    }
    if (!device.is_simulated && !typed.trajectory.empty()) {
        throw std::invalid_argument("--trajectory: only --device simulated follows one");
    }
    if (!typed.scene.empty()) options.scene.name = typed.scene;
    if (!typed.case_name.empty()) {
        options.scene = case_chosen(typed.case_name);
        options.case_name = name_of_case(typed.case_name);
        options.outputs.case_folder = options.scene.case_folder;
    }
    options.scene.bone = path_if_given(typed.bone);
    options.scene.changes = scene_changes(typed);
    if (options.scene.bone && !options.scene.name && !options.scene.changes.changes.empty())
        throw std::invalid_argument(fmt::format(
            "{}: of a scene; --bone alone has none, name one with --scene", options.scene.changes.option));
    if (typed.spindle_rpm > 0.0) options.scene.spindle_rpm = typed.spindle_rpm;
    options.grip = typed.grip == "light" ? Grip::light : Grip::firm;
    if (typed.grip == rails_name) options.grip.reset();
    if (!options.grip && !device.is_simulated)
        throw std::invalid_argument(fmt::format("--grip {}: goes with --device simulated", rails_name));
    options.scene.trajectory = path_if_given(typed.trajectory);
    options.session.clock = is_virtual ? ClockKind::virtual_time : ClockKind::real;
    options.session.coupling = checked_coupling(typed, device);
    options.session.force_model = typed.force_model;
    options.session.vibration = checked_vibration(typed);
    options.session.duration_s = typed.duration_s;
    if (typed.haptic_cpu >= 0) options.session.haptic_cpu = typed.haptic_cpu;
    if (typed.milling_cpu >= 0) options.session.milling_cpu = typed.milling_cpu;
    options.session.milling_rate_hz =
        typed.milling_rate_hz > 0.0
            ? typed.milling_rate_hz
            : usual_milling_rate_hz(options.session.coupling, options.session.force_model);
    try {
        options.listen = listen_address(typed);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("--listen: {}", error.what()));
    }
    if (options.listen) options.access = access.access_to(*options.listen);
    options.metrics = metrics_address(typed);
    options.logs_json = typed.log_json;
    if (is_client && !options.listen) {
        throw std::invalid_argument("--device client: the operator connects over --listen, which is none");
    }
    options.operators = path_if_given(typed.operators);
    if (options.operators && !is_client)
        throw std::invalid_argument(
            "--operators: goes with --device client; with others no client moves the tool");
    if (options.operators && !options.access.tls)
        throw std::invalid_argument(
            "--operators: needs TLS (--tls-cert, --tls-key, --tls-ca), which says who a client is");
    options.controls = path_if_given(typed.controls);
    options.record = path_if_given(typed.record);
    options.outputs.report = path_if_given(typed.report);
    if (options.outputs.report && options.record)
        throw std::invalid_argument("--record: --report records already, as DIR/session.pcap");
    if (options.outputs.report) options.record = recording_in(*options.outputs.report);
    options.records_ticks = typed.record_rate_hz == "1000";
    options.trainee = checked_trainee(typed.trainee);
    options.outputs.save_bone = path_if_given(typed.save_bone);
    if (options.outputs.save_bone && options.outputs.save_bone->extension() != ".nrrd") {
        throw std::invalid_argument(fmt::format("--save-bone: '{}' must end in .nrrd", typed.save_bone));
    }
    options.outputs.json = path_if_given(typed.json);
    if (options.outputs.json) options.outputs.json_histograms = histograms_beside(*options.outputs.json);
    options.logs.force = path_if_given(typed.log_csv);
    options.logs.milling = path_if_given(typed.log_milling_csv);
    options.checks_machine = typed.check;
    require_distinct_files(options, access);
    return options;
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version) {
    Typed typed;
    CLI::App app(
        "Owns the bone, mills it at up to 10 kHz, feeds forces to the hand and shows clients the rest.",
        "haptic_server");
    app.set_version_flag("--version", fmt::format("haptic_server {}", version));
    declare(app, typed);
    const AccessOptions access(app);
    if (auto text = parse_or_text(app, argc, argv)) return {std::nullopt, *std::move(text)};
    return {checked(typed, access), {}};
}

}  // namespace osteomill
