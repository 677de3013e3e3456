#include "haptic_server/program/server.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "analysis/report/write_report.h"
#include "analysis/surface/mesh_file.h"
#include "analysis/surface/surface_mesh.h"
#include "common/log/line_stream.h"
#include "common/scene/scene_file.h"
#include "common/wire/ct_pieces.h"
#include "devices/hid/device_list.h"
#include "devices/hid/hidapi_transport.h"
#include "haptic_server/program/device_parts.h"
#include "haptic_server/program/measurements.h"
#include "haptic_server/program/report_folder.h"
#include "haptic_server/program/resident_memory.h"
#include "haptic_server/program/session_keeper.h"
#include "haptic_server/program/session_settings.h"
#include "haptic_server/program/status_line.h"
#include "haptic_server/program/tool_place.h"
#include "haptic_server/streaming/live_session.h"
#include "haptic_server/streaming/streaming_server.h"
#include "imaging/case/bone_source.h"
#include "imaging/case/case_placement.h"
#include "imaging/case/case_trust.h"
#include "imaging/case/scene_on_bone.h"
#include "imaging/memory_estimate.h"
#include "imaging/phantoms/phantom.h"
#include "imaging/progress.h"
#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/loop/force_log.h"
#include "simulation/loop/real_time.h"
#include "simulation/loop/thread_priority.h"

namespace osteomill {

namespace {

/// The scene that the options name; where they name only a bone, one without a place for the tool yet.
Scene load_scene(const ServerOptions& options) {
    Scene scene;
    if (options.bone && !options.scene) {
        scene = scene_of_bone_file(*options.bone);
    } else {
        const std::vector<std::string> phantoms = phantom_names();
        const std::string name = options.scene.value_or(phantoms.front());
        const bool is_phantom = std::find(phantoms.begin(), phantoms.end(), name) != phantoms.end();
        scene = is_phantom ? phantom_scene(name) : read_scene(name);
        if (options.case_folder) require_own_files(scene, *options.case_folder);
        if (options.bone) {
            const auto* before = std::get_if<FileSource>(&scene.bone);
            scene.bone = FileSource{.path = *options.bone,
                                    .threshold_hu = {},
                                    .segmentation = before != nullptr ? before->segmentation : ""};
        }
    }
    if (options.trajectory) scene.trajectory.source = *options.trajectory;
    if (options.case_folder)
        scene.start_pose = placement_of_case(*options.case_folder).value_or(scene.start_pose);
    return scene;
}

/// Before an hour of work rather than after it.
void require_folder_of(const std::optional<std::filesystem::path>& file) {
    if (!file || !file->has_parent_path() || std::filesystem::is_directory(file->parent_path())) return;
    throw std::runtime_error(
        fmt::format("{}: there is no folder {}", file->string(), file->parent_path().string()));
}

/// Nothing on the real clock, of which people know how it goes.
std::optional<double> done_of_virtual_session(const ServerOptions& options, const DeviceParts& device,
                                              double time_s) {
    if (options.session.clock == ClockKind::real) return std::nullopt;
    const double of_trajectory = device.simulated != nullptr ? device.simulated->done() : 0.0;
    return std::min(1.0, std::max(time_s / options.session.duration_s, of_trajectory));
}

/// What shows the session to clients, and records it, and lets them control it.
struct Streaming {
    std::unique_ptr<SessionKeeper> keeper;
    std::unique_ptr<SessionControls> controls;
    std::unique_ptr<LiveSession> shown;
    std::unique_ptr<StreamingServer> server;  // null: nobody looks on

    explicit operator bool() const { return server != nullptr; }
    bool has_been_asked_to_finish() const { return keeper && keeper->has_been_asked_to_finish(); }
};

/// The spring that the hand is on, and why no stiffer; what makes forces others than bone's.
void say_what_is_felt(const DeviceLimits& arm, const Scene& scene, LineStream& out) {
    if (arm.gives_force)
        out.write(fmt::format("the hand is on a spring of {:.3g} N/mm: {}\n", arm.max_stiffness_n_per_mm,
                              arm.stiffness_is_limited_by));
    if (scene.force_scale != 1.0)
        out.write(fmt::format("{}: forces of cutting are {:.3g} times the bone's (force_scale)\n", scene.name,
                              scene.force_scale));
}

Streaming make_streaming(StreamingOptions wanted, const ServerOptions& options, const Scene& scene,
                         Bone mirror, MillingSession& session, const DeviceParts& device,
                         std::vector<Structure> structures, const std::string& version,
                         SessionKeeper::Save save, std::function<CtVolume()> make_ct,
                         std::optional<ToolPose>& placed, LineStream& out) {
    wanted.listens = options.listen.has_value();
    wanted.paced_by_session = options.session.clock == ClockKind::virtual_time;
    if (options.record)
        wanted.record = RecordTo{.file = *options.record, .began = std::chrono::system_clock::now()};
    Streaming streaming;
    streaming.keeper = std::make_unique<SessionKeeper>(std::move(save));
    SessionControls::Requests requests = streaming.keeper->requests();
    if (options.report)
        requests.finish_words =
            fmt::format("its report: {} on the server", (*options.report / "report.html").string());
    if (device.simulated == nullptr)
        requests.place = [burrs = scene.burrs](const Bone& bone, const ToolPose& place, std::size_t burr) {
            return clear_place(bone, burr_hull(burrs[burr]), place);
        };
    // Of the streaming thread, which is over when it is read.
    requests.placed = [&placed](const ToolPose& pose) { placed = pose; };
    streaming.controls = std::make_unique<SessionControls>(*session.gate(), *session.restored(),
                                                           session.placements(), std::move(requests));
    streaming.shown = std::make_unique<LiveSession>(
        session.tool(), session.changes(), streaming.controls.get(),
        options.controls ? read_control_script(*options.controls) : ControlScript{});
    streaming.shown->listen_to(session.cuts());
    SessionInfo info =
        session_info(scene, device.operator_channel != nullptr, device.device->limits().max_force_n, version);
    info.has_ct = static_cast<bool>(make_ct);
    streaming.shown->offer_ct(std::move(make_ct));
    info.accepts_controls = options.session.clock == ClockKind::real;
    info.trainee = options.trainee;
    info.case_name = options.case_name;
    info.settings = as_texts(session_settings(options, scene, version));
    const std::vector<Structure> to_send = not_told_by_bone(structures, scene, mirror);
    streaming.shown->watch(StructureWatch(std::move(structures), scene.tissues, scene.burrs), scene.tissues);
    streaming.server =
        std::make_unique<StreamingServer>(std::move(wanted), std::move(info), std::move(mirror),
                                          *streaming.shown, device.operator_channel.get(), to_send);
    streaming.server->start();
    if (options.listen)
        out.write(fmt::format("listening on {}:{}\n", options.listen->address, streaming.server->port()));
    return streaming;
}

void save_surface(const std::filesystem::path& path, const Bone& bone) {
    const SurfaceMesh mesh = surface_of(bone);
    if (mesh.triangles.empty()) throw std::runtime_error("nothing is left of the bone");
    write_mesh(path, mesh);
}

/// Everything that a run leaves behind, written although one of them fails; the first failure is thrown.
class RunOutputs {
  public:
    template <typename Write>
    void write(Write&& write_one) {
        try {
            write_one();
        } catch (const std::exception& error) {
            if (error_.empty()) error_ = error.what();
        }
    }
    void require_complete() const {
        if (!error_.empty()) throw std::runtime_error(error_);
    }

  private:
    std::string error_;
};

template <typename Log>
void begin_log(std::optional<Log>& log, const std::optional<std::filesystem::path>& file,
               const char* header_line) {
    if (!file) return;
    log.emplace(*file, header_line);
    if (log->torn()) spdlog::warn("{}", torn_line(*file, *log->torn()));
}

template <typename Log>
void close_log(std::optional<Log>& log) {
    if (!log) return;
    log->close();
    if (!log->error().empty()) throw std::runtime_error(log->error());
    if (log->dropped() > 0) {
        throw std::runtime_error(fmt::format("{}: {} lines are missing: the disk could not keep up",
                                             log->path().string(), log->dropped()));
    }
}

void say_what_was_removed_before(const BoneSource& source, LineStream& out) {
    const double mm3 =
        std::accumulate(source.removed_before_mm3.begin(), source.removed_before_mm3.end(), 0.0);
    if (mm3 > 0.0)
        out.say(fmt::format("{}: {:.2f} mm^3 were removed before; the count goes on from there",
                            source.file->path().string(), mm3));
}

/// A bone of which saving takes long says how far it has come.
void save_and_tell(const std::filesystem::path& path, const BoneSource& source, const Bone& bone,
                   LineStream& out) {
    constexpr std::uint64_t many_voxels = std::uint64_t{1} << 28;
    const bool takes_long = source.file && voxel_count(bone.grid()) > many_voxels;
    LineStreamBuffer buffer(out);
    std::ostream messages(&buffer);
    messages << std::unitbuf;
    ProgressLine progress(messages, out.is_terminal(), "saving");
    save_bone(path, source, bone, [&](double done) {
        if (takes_long) progress.report(done);
    });
}

}  // namespace

void run_server(const ServerOptions& options, const std::string& version, StopFlag stop_flag,
                const ProgramOutput& output) {
    if (options.lists_devices) {
        HidapiTransport transport;
        output.out->write(device_list(transport));
        return;
    }
    const auto began = std::chrono::steady_clock::now();
    if (options.report) prepare_report_folder(*options.report);
    for (const auto& file : {options.save_bone, options.json, options.json_histograms, options.log_csv,
                             options.log_milling_csv, options.record})
        require_folder_of(file);
    StreamingOptions streaming_as_typed =
        streaming_options(options.listen.value_or(ListenAddress{}), options.access);
    if (options.operators) streaming_as_typed.operators.emplace(*options.operators);
    const omb_key bridge_key = read_bridge_key(options);
    Scene scene = load_scene(options);
    if (options.case_folder)
        if (const std::string line = unsigned_files(scene, *options.case_folder); !line.empty())
            spdlog::warn("{}", line);
    std::ifstream meminfo("/proc/meminfo");
    LoadedBone loaded = load_bone(scene, available_memory_bytes(meminfo));
    if (!loaded.doubt.empty())
        spdlog::warn("{}: {}", std::get<FileSource>(scene.bone).path.string(), loaded.doubt);
    if (options.bone && !options.scene) place_on_bone(scene, loaded.bone);
    // From here on there is something to end in order; what came before, a signal ends at once.
    const std::atomic<bool>& stop = stop_flag();
    const BoneSource source = std::move(loaded.source);
    say_what_was_removed_before(source, *output.err);
    Bone bone = std::move(loaded.bone);
    BoneCost cost{.memory_bytes = memory_bytes(bone), .bone_mm3 = bone_volume_mm3(bone)};
    const DeviceParts device = make_device(options, bridge_key, scene, stop, *output.out);
    if (device.device == nullptr) return;  // stopped before an arm came
    say_what_is_felt(device.device->limits(), scene, *output.out);
    std::optional<ForceLog> log;
    begin_log(log, options.log_csv,
              has_shank(scene.burrs) ? ForceSample::header_line_with_shank : ForceSample::header_line);
    std::optional<MillingLog> milling_log;
    begin_log(milling_log, options.log_milling_csv, MillingSample::header_line);

    MillingSessionOptions session_options = options.session;
    session_options.removed_before_mm3 = source.removed_before_mm3;
    const bool is_shown = options.listen || options.record || options.controls;
    session_options.changes_are_consumed = session_options.can_be_controlled = is_shown;
    std::optional<Bone> mirror;
    if (is_shown) mirror = bone;
    const auto session =
        std::make_unique<MillingSession>(scene, std::move(bone), *device.device, session_options,
                                         log ? &*log : nullptr, milling_log ? &*milling_log : nullptr);
    SessionKeeper::Save save;
    if (options.save_bone)
        save = [&](const Bone& now, const std::string& mesh_ending) -> std::string {
            try {
                if (mesh_ending.empty())
                    save_bone(*options.save_bone, source, now);
                else
                    save_surface(std::filesystem::path(*options.save_bone).replace_extension(mesh_ending),
                                 now);
            } catch (const std::exception& error) {
                return error.what();
            }
            return {};
        };
    std::optional<ToolPose> placed;
    std::function<CtVolume()> make_ct;
    if (has_ct(source, session->bone().grid())) make_ct = [&] { return ct_of(source, most_ct_voxels); };
    const Streaming streaming =
        is_shown ? make_streaming(std::move(streaming_as_typed), options, scene, *std::move(mirror), *session,
                                  device, std::move(loaded.structures), version, std::move(save),
                                  std::move(make_ct), placed, *output.out)
                 : Streaming{};

    cost.startup_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

    if (options.session.clock == ClockKind::real) {
        const std::string advice =
            advice_on_rights(real_time_rights(), std::filesystem::read_symlink("/proc/self/exe").string());
        if (!advice.empty()) spdlog::warn("{}", advice);
    }
    if (options.session.vibration && std::none_of(scene.burrs.begin(), scene.burrs.end(), vibrates_in_reach))
        spdlog::warn(
            "--vibration: no burr of the scene vibrates at {:.0f} Hz or below: there is nothing to render",
            HandpieceVibration::highest_hz);
    StatusLine status(*output.err, output.err->is_terminal());
    std::atomic<bool> is_over{false};
    session->run(is_over, [&](const ToolState& tool) {
        status.show(tool, StatusLine::Clock::now(), done_of_virtual_session(options, device, tool.time_s));
        status.show_notice(tool, device.device->notice());
        if (streaming && options.session.clock == ClockKind::virtual_time) streaming.server->show_frame();
        if (stop.load() || device.is_finished() || streaming.has_been_asked_to_finish()) is_over.store(true);
    });
    status.finish();
    if (streaming) streaming.server->end();
    if (streaming) streaming.keeper->wait();

    std::ifstream process("/proc/self/status");
    const std::uint64_t peak_bytes = peak_resident_bytes(process).value_or(0);
    // What matters most first, and nothing waits for a client that is slow to read the end.
    const MillingSessionReport report = session->report();
    RunOutputs outputs;
    outputs.write([&] {
        if (options.save_bone) save_and_tell(*options.save_bone, source, session->bone(), *output.err);
    });
    outputs.write([&] {
        if (options.case_folder && placed) remember_placement(*options.case_folder, *placed);
    });
    outputs.write([&] { close_log(log); });
    outputs.write([&] { close_log(milling_log); });
    if (streaming) streaming.server->finish_recording();
    const auto recording = streaming ? streaming.server->recording() : std::nullopt;
    outputs.write([&] {
        if (!options.json) return;
        auto json = measurements(report, cost, peak_bytes, scene, options);
        json["settings"] = session_settings(options, scene, version);
        if (streaming) add_structures(json, streaming.shown->structures(), scene);
        if (recording) json["recording"] = recorded(*recording);
        write_json(json, *options.json);
    });
    outputs.write([&] {
        if (options.json_histograms) write_json(histograms_us(report), *options.json_histograms);
    });
    outputs.write([&] {
        if (recording && !recording->error.empty()) throw std::runtime_error(recording->error);
        if (!options.report) return;
        const std::string error = write_report(recording_in(*options.report), *options.report, [] {});
        if (!error.empty()) throw std::runtime_error(error);
        output.out->say(fmt::format("report: {}", (*options.report / "report.html").string()));
    });
    if (streaming) streaming.server->stop();
    outputs.write([&] {
        if (streaming && streaming.server->mirror_checksum() != report.bone_checksum) {
            throw std::runtime_error(
                fmt::format("the bone that clients were shown ({:016x}) is not the one milled ({:016x})",
                            streaming.server->mirror_checksum(), report.bone_checksum));
        }
    });
    outputs.require_complete();
}

}  // namespace osteomill
