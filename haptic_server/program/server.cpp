#include "haptic_server/program/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "common/files/atomic_file.h"
#include "common/files/distinct_files.h"
#include "common/log/log.h"
#include "devices/hid/device_list.h"
#include "devices/hid/hid_transport.h"
#include "devices/measured/measured_profile.h"
#include "devices/simulated/simulated_device.h"
#include "haptic_server/check/machine_check.h"
#include "haptic_server/check/session_check.h"
#include "haptic_server/measuring/arm_measurement.h"
#include "haptic_server/monitoring/metrics_server.h"
#include "haptic_server/monitoring/prometheus_text.h"
#include "haptic_server/program/session_json.h"
#include "haptic_server/program/session_outputs.h"
#include "haptic_server/program/status_line.h"
#include "haptic_server/session/session_assembly.h"
#include "haptic_server/session/session_settings.h"
#include "imaging/phantoms/phantom.h"
#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

namespace {

/// Before an hour of work rather than after it.
void require_place_for(const std::optional<std::filesystem::path>& file) {
    if (!file) return;
    if (std::filesystem::is_directory(*file))
        throw std::runtime_error(fmt::format("{}: is a folder; it should be a file", file->string()));
    if (file->has_parent_path() && !std::filesystem::is_directory(file->parent_path()))
        throw std::runtime_error(
            fmt::format("{}: there is no folder {}", file->string(), file->parent_path().string()));
    // A pipe is opened when it is written.
    if (!write_target(*file, Link::follow).is_direct) AtomicFile{*file};
}

/// Throws if something is wrong, after reporting all of it.
void check(const ServerOptions& options, const ProgramOutput& output) {
    std::filesystem::path records_in = options.record.value_or("").parent_path();
    while (!records_in.empty() && !std::filesystem::exists(records_in)) records_in = records_in.parent_path();
    HidapiTransport transport;
    std::vector<CheckRow> rows = check_machine(this_machine());
    rows.push_back(check_devices(transport));
    for (CheckRow& row : check_session({.listen = options.listen,
                         .tls = options.access.tls,
                         .records_in = records_in.empty() ? "." : records_in}))
        rows.push_back(std::move(row));
    output.out->write(text_of(rows));
    if (must_be_mended(rows)) throw std::runtime_error("the machine is not ready for a session: see above");
}

/// Nothing if there are neither clients nor a recording. Reads the files of TLS and the list of operators.
std::optional<ShownOptions> shown_options(const ServerOptions& options, const std::string& version) {
    StreamingOptions streaming = streaming_options(options.listen.value_or(ListenAddress{}), options.access);
    if (options.operators) streaming.operators.emplace(*options.operators);
    if (!options.listen && !options.record && !options.controls) return std::nullopt;
    streaming.listens = options.listen.has_value();
    streaming.waits_for_client = options.waits_for_client;
    return ShownOptions{
        .streaming = std::move(streaming),
        .script = options.controls ? read_control_script(*options.controls) : ControlScript{},
        .words_at_finish = options.outputs.report
                               ? fmt::format("its report: {} on the server",
                                             (*options.outputs.report / "report.html").string())
                               : "",
        .accepts_controls = options.milling.clock == ClockKind::real,
        .version = version,
        .trainee = options.trainee,
        .case_name = options.case_name};
}

/// Those of the command line, and those that the scene names.
std::vector<NamedFile> all_files(const ServerOptions& options, const SessionScene& scene) {
    std::vector<NamedFile> files = options.files;
    files.insert(files.end(), scene.files_read.begin(), scene.files_read.end());
    return files;
}

/// The spring that the hand is on, and why it is no stiffer; and settings that make the forces differ from
/// bone's.
void say_what_is_felt(const DeviceLimits& arm, const Scene& scene, LineStream& out) {
    if (arm.gives_force)
        out.write(fmt::format("the hand is on a spring of {:.3g} N/mm: {}\n", arm.max_stiffness_n_per_mm,
                              arm.stiffness_is_limited_by));
    if (scene.force_scale != 1.0)
        out.write(fmt::format("{}: forces of cutting are {:.3g} times the bone's (force_scale)\n", scene.name,
                              scene.force_scale));
}

void say_what_was_removed_before(const BoneSource& source, LineStream& out) {
    const double mm3 =
        std::accumulate(source.removed_before_mm3.begin(), source.removed_before_mm3.end(), 0.0);
    if (mm3 > 0.0)
        out.say(fmt::format("{}: {:.2f} mm^3 were removed before; the count goes on from there",
                            source.file->path().string(), mm3));
}

void say_what_to_know(const MillingSessionOptions& options, const Scene& scene) {
    if (options.clock == ClockKind::real) {
        const std::string advice =
            advice_on_rights(real_time_rights(), std::filesystem::read_symlink("/proc/self/exe").string());
        if (!advice.empty()) log_warning("{}", advice);
    }
    if (options.vibration && std::ranges::none_of(scene.burrs, vibrates_in_reach))
        log_warning(
            "--vibration: no burr of the scene vibrates at {:.0f} Hz or below: there is nothing to render",
            HandpieceVibration::highest_hz);
}

void run(SessionAssembly& assembly, EndPlaces& places, const std::atomic<bool>& stop, LineStream& err) {
    StatusLine status(err, err.is_terminal());
    const auto say_what_is_wrong = [&] {
        for (const std::string& line : places.check(assembly.source()))
            if (assembly.shown() != nullptr)
                assembly.shown()->tell(line);
            else
                log_error("{}", line);
    };
    // People know how a session on the real clock goes.
    const bool shows_progress = assembly.options().clock == ClockKind::virtual_time;
    assembly.run(stop, [&](const ToolState& tool) {
        status.show(tool, StatusLine::Clock::now(),
                    shows_progress ? std::optional(assembly.done(tool.time_s)) : std::nullopt);
        status.show_notice(tool, assembly.device().notice());
        if (places.check_is_due()) say_what_is_wrong();
    });
    status.finish();
    say_what_is_wrong();
}

/// The simulated arm in a hand that holds it at a place, with the pedal down.
DeviceParts held_arm(const Scene& scene, Grip grip) {
    DeviceParts parts;
    parts.device = std::make_unique<SimulatedDevice>(
        Trajectory({{.time_s = 0.0, .pose = scene.start_pose, .pedal = true}}), scene.device, ArmModel{},
        hand_model(grip));
    parts.delay_s = 0.0;
    return parts;
}

/// haptic_server --measure-arm: measures the arm of --device and writes its profile, instead of a session.
/// Throws std::runtime_error with one line if there is no arm or the measurement ended before there was a
/// spring; no profile is written then, but the findings are on standard output.
void run_measuring(const ServerOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output) {
    const std::filesystem::path& file = *options.measures_into;
    const Scene scene = phantom_scene("tooth");  // a device is made for a scene; none is milled
    const auto say = [&](const std::string& line) { output.err->say(line); };
    const DeviceEntry& entry = *options.device.entry;
    const DeviceParts parts =
        entry.is_simulated
            ? held_arm(scene, options.grip.value_or(Grip::firm))
            : options.device.prepare()(
                  {.scene = scene, .grip = options.grip, .stop = stop, .say = say, .as_stated = true});
    if (parts.device == nullptr) return;  // stopped before an arm came
    const DeviceLimits stated = parts.device->limits();
    const ArmMeasurement found =
        measure_arm(*parts.device, {.delay_s = parts.delay_s,
                                    .is_virtual = options.milling.clock == ClockKind::virtual_time,
                                    .stop = stop,
                                    .say = say});
    const std::string name = parts.device->name();
    output.out->write(text_of(found, name, stated, parts.delay_s));
    if (!found.has_spring())
        throw std::runtime_error(fmt::format(
            "the measurement ended without a spring: {}; nothing was written", why_no_spring(found)));
    write_atomic_file(file, parts.profile.empty()
                                ? measured_profile_text({.arm = name, .measured = found.arm})
                                : with_measured_table(parts.profile, found.arm));
    output.out->write(fmt::format("{} is written: haptic_server --device {} --device-profile {}\n",
                                  file.string(), entry.name, file.string()));
}

}  // namespace

void run_server(const ServerOptions& options, const std::string& version, StopFlag stop_flag,
                const ProgramOutput& output) {
    if (options.device.lists_devices) {
        HidapiTransport transport;
        output.out->write(device_list(transport));
        return;
    }
    if (options.checks_machine) return check(options, output);
    if (options.logs_json) output.err->use_json();
    if (options.measures_into) {
        require_place_for(options.measures_into);
        return run_measuring(options, stop_flag(), output);
    }
    const auto began = std::chrono::steady_clock::now();
    if (options.outputs.report) prepare_report_folder(*options.outputs.report);
    for (const auto& file : {options.outputs.save_bone, options.outputs.json, options.outputs.json_histograms,
                             options.logs.force, options.logs.milling, options.record})
        require_place_for(file);
    EndPlaces places(options.outputs);
    std::optional<ShownOptions> shown = shown_options(options, version);
    if (shown) shown->save_bone = places.save_bone();
    const MakeDevice make_device = options.device.prepare();
    SessionScene scene = load_session_scene(options.scene);
    require_distinct(all_files(options, scene));
    // From here on the program has to end in order; before, a signal ends it at once.
    const std::atomic<bool>& stop = stop_flag();
    say_what_was_removed_before(scene.source, *output.err);
    BoneCost cost{.memory_bytes = memory_bytes(scene.bone), .bone_mm3 = bone_volume_mm3(scene.bone)};
    DeviceParts device = make_device(
        {.scene = scene.scene, .grip = options.grip, .stop = stop, .say = [&](const std::string& line) {
             output.out->say(line);
         }});
    if (device.device == nullptr) return;  // stopped before an arm came
    say_what_is_felt(device.device->limits(), scene.scene, *output.out);
    scene = seated(std::move(scene), device);
    nlohmann::ordered_json settings = session_settings(
        options.milling, options.scene, scene,
        {.device = options.device.entry->name, .grip = options.grip, .arm = device.device->limits()},
        version);
    if (options.controls) settings["controls"] = options.controls->filename().string();
    if (shown) {
        shown->settings = as_texts(settings);
        shown->scene_toml = effective_scene_text(scene.scene);
    }
    if (options.record)
        shown->streaming.record = RecordTo{.file = *options.record,
                                           .began = std::chrono::system_clock::now(),
                                           .with_ticks = options.records_ticks};

    TickMeter meter;
    SessionAssembly assembly(std::move(scene), std::move(device),
                             {.milling = options.milling,
                              .logs = options.logs,
                              .more_ticks = options.metrics ? &meter : nullptr,
                              .shown = std::move(shown)});
    std::optional<MetricsServer> metrics;
    if (options.metrics) {
        const auto text = [&meter, &assembly, &version] {
            return prometheus_text(
                meter.read(), assembly.shown() ? assembly.shown()->server().traffic() : StreamingTraffic{},
                version);
        };
        metrics.emplace(*options.metrics, text, options.metrics_hosts);
        output.out->write(
            fmt::format("metrics on {}\n", text_of_address(options.metrics->address, metrics->port())));
    }
    if (options.listen)
        output.out->write(
            fmt::format("listening on {}\n",
                        text_of_address(options.listen->address, assembly.shown()->server().port())));
    cost.startup_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    say_what_to_know(options.milling, assembly.scene());
    run(assembly, places, stop, *output.err);

    std::ifstream process("/proc/self/status");
    const std::uint64_t peak_bytes = peak_resident_bytes(process).value_or(0);
    write_outputs(assembly, places.now(), cost, peak_bytes, settings, output);
}

}  // namespace osteomill
