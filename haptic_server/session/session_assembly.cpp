#include "haptic_server/session/session_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/files/session_file.h"
#include "common/log/log.h"
#include "common/scene/device_mapping.h"

namespace osteomill {

namespace {

template <typename Log>
void begin_log(std::optional<Log>& log, const std::optional<std::filesystem::path>& file,
               const std::string& header_line) {
    if (!file) return;
    log.emplace(*file, header_line);
    if (log->torn()) log_warning("{}", torn_line(*file, *log->torn()));
}

template <typename Log>
void close_log(std::optional<Log>& log) {
    if (!log) return;
    log->close();
    if (!log->error().empty()) throw std::runtime_error(log->error());
    if (log->dropped() > 0)
        throw std::runtime_error(fmt::format("{}: {} lines are missing: the disk could not keep up",
                                             log->path().string(), log->dropped()));
}

}  // namespace

SessionLogs::SessionLogs(const LogFiles& files, bool has_shank) {
    begin_log(force_, files.force, TickSample::header_line(has_shank));
    begin_log(milling_, files.milling, MillingSample::header_line());
}

void SessionLogs::close_force() {
    close_log(force_);
}

void SessionLogs::close_milling() {
    close_log(milling_);
}

SessionScene seated(SessionScene scene, const DeviceParts& device) {
    Scene& on_patient = scene.scene;
    if (device.mapping)
        on_patient.device = *device.mapping;
    else if (device.home_mm && on_patient.device == DeviceMapping{})
        on_patient.device.offset_mm = on_patient.start_pose.position_mm - *device.home_mm;
    return scene;
}

namespace {

MillingSessionOptions milling_options(const SessionOptions& options, const SessionScene& scene,
                                      const DeviceParts& device) {
    const bool never_ends = std::isinf(options.milling.duration_s) && device.simulated != nullptr &&
                            std::isinf(device.simulated->duration_s());
    if (options.milling.clock == ClockKind::virtual_time && never_ends)
        throw std::runtime_error("--clock virtual: the trajectory never ends; give --duration-s");
    MillingSessionOptions milling = options.milling;
    milling.removed_before_mm3 = scene.source.removed_before_mm3;
    if (!scene.scene.fixtures.empty()) milling.structures = scene.structures;
    milling.changes_are_consumed = milling.can_be_controlled = options.shown.has_value();
    return milling;
}

/// The logs, once no file of the session is one that its scene is made of.
const LogFiles& checked_logs(const SessionOptions& options, const SessionScene& scene) {
    std::vector<NamedFile> files = scene.files_read;
    const auto add = [&files](const char* what, const std::optional<std::filesystem::path>& file) {
        if (file) files.push_back({what, *file});
    };
    add("the log of forces", options.logs.force);
    add("the log of milling", options.logs.milling);
    if (options.shown) {
        if (options.shown->streaming.record) add("the recording", options.shown->streaming.record->file);
        if (options.shown->save_bone != nullptr) add("--save-bone", options.shown->save_bone->file());
    }
    require_distinct(files);
    return options.logs;
}

/// Null: nothing is recorded.
RecordTo* record_to(SessionOptions& options) {
    if (!options.shown || !options.shown->streaming.record) return nullptr;
    return &*options.shown->streaming.record;
}

}  // namespace

SessionAssembly::SessionAssembly(SessionScene scene, DeviceParts device, SessionOptions options)
    : scene_(seated(std::move(scene), device)),
      device_(std::move(device)),
      options_(milling_options(options, scene_, device_)),
      logs_(checked_logs(options, scene_), has_shank(scene_.scene.burrs)) {
    std::optional<Bone> mirror;
    if (options.shown) mirror = scene_.bone;
    if (RecordTo* record = record_to(options); record != nullptr && record->with_ticks)
        tick_logs_.add(record->ticks = &recorded_ticks_.emplace());
    tick_logs_.add(logs_.force());
    tick_logs_.add(options.more_ticks);
    session_ = std::make_unique<MillingSession>(scene_.scene, std::move(scene_.bone), *device_.device,
                                                options_, &tick_logs_, logs_.milling());
    options_.structures.clear();
    if (!options.shown) return;
    options.shown->streaming.paced_by_session = is_virtual();
    shown_.emplace(*std::move(options.shown), scene_, *std::move(mirror), *session_, device_);
}

SessionAssembly::SessionAssembly(const SessionAssembly& other, DeviceParts device)
    : scene_{.scene = other.scene_.scene, .bone = other.scene_.bone, .source = other.scene_.source},
      device_(std::move(device)),
      options_(other.options_),
      logs_({}, has_shank(scene_.scene.burrs)),
      session_(std::make_unique<MillingSession>(*other.session_, *device_.device)) {
    options_.changes_are_consumed = options_.can_be_controlled = false;
}

void SessionAssembly::run(const std::atomic<bool>& stop, const OnProgress& on_progress) {
    if (shown_) shown_->wait_for_client(stop);
    std::atomic<bool> is_over{stop.load() || (shown_ && shown_->finish_requested())};
    session_->run(is_over, [&](const ToolState& tool) {
        if (on_progress) on_progress(tool);
        show_frame();
        if (stop.load() || device_.is_finished() || (shown_ && shown_->finish_requested()))
            is_over.store(true);
    });
    if (shown_) shown_->end();
}

std::uint64_t SessionAssembly::advance(std::uint64_t ticks) {
    return session_->advance(ticks, [this](const ToolState&) { show_frame(); });
}

void SessionAssembly::end() {
    session_->end([this](const ToolState&) { show_frame(); });
    if (shown_) shown_->end();
}

double SessionAssembly::done(double time_s) const {
    const double of_trajectory = device_.simulated != nullptr ? device_.simulated->done() : 0.0;
    return std::min(1.0, std::max(time_s / options_.duration_s, of_trajectory));
}

void SessionAssembly::show_frame() {
    if (shown_ && is_virtual()) shown_->server().show_frame();
}

}  // namespace osteomill
