#include "haptic_server/replay/replay.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <list>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "analysis/replay/recording_csv.h"
#include "analysis/replay/recording_sound.h"
#include "analysis/replay/recording_summary.h"
#include "analysis/report/write_report.h"
#include "analysis/surface/mesh_file.h"
#include "analysis/surface/surface_mesh.h"
#include "common/files/atomic_file.h"
#include "common/program/progress.h"
#include "common/program/run_program.h"
#include "common/recording/playhead.h"
#include "common/words/translation.h"
#include "haptic_server/replay/recorded_session.h"
#include "haptic_server/streaming/streaming_server.h"
#include "imaging/bone_file/removed_bone.h"

namespace osteomill {

namespace {

void require_going_on(const std::atomic<bool>& stop) {
    if (stop.load()) throw std::runtime_error("interrupted; nothing was written");
}

/// The progress of a reading that takes seconds, on standard error, until somebody stops it.
class Reading {
  public:
    Reading(const ReplayOptions& options, const std::atomic<bool>& stop, std::string title)
        : stop_(stop), line_(std::cerr, ::isatty(STDERR_FILENO) == 1, std::move(title)) {
        constexpr std::uintmax_t long_recording_bytes = std::uintmax_t{1} << 24;
        std::error_code unknown;
        const auto bytes = std::filesystem::file_size(options.recording, unknown);
        takes_long_ = !unknown && bytes > long_recording_bytes;
    }
    void operator()(double done) {
        require_going_on(stop_);
        if (takes_long_) line_.report(done);
    }

  private:
    const std::atomic<bool>& stop_;
    ProgressLine line_;
    bool takes_long_ = false;
};

/// The surface of the remaining bone, and the removed bone, as far as the recording can be read. Returns why
/// it is not read further.
std::string write_bones(const ReplayOptions& options, const std::atomic<bool>& stop) {
    Reading reading(options, stop, "bones");
    const RecordedBones bones = bones_of(options.recording, std::ref(reading));
    if (options.difference) save_removed(*options.difference, bones.at_start, bones.at_end);
    if (options.surface) {
        const SurfaceMesh mesh = surface_of(bones.at_end);
        if (mesh.triangles.empty())
            throw std::runtime_error(
                fmt::format("{}: its bone has no surface at the end: no voxel is more than half full",
                            options.recording.string()));
        write_mesh(*options.surface, mesh);
    }
    return bones.error;
}

void read(const ReplayOptions& options, const std::atomic<bool>& stop) {
    std::list<RecordingCsv> tables;
    if (options.csv) tables.emplace_back(*options.csv, CsvLines::ticks);
    if (options.states_csv) tables.emplace_back(*options.states_csv, CsvLines::states);
    if (options.trajectory) tables.emplace_back(*options.trajectory, CsvLines::trajectory);
    std::optional<RecordingSound> sound;
    if (options.sound) sound.emplace(*options.sound);
    const RecordingSummary summary = summarise(options.recording, [&](const Playhead& playhead) {
        require_going_on(stop);
        for (RecordingCsv& table : tables) table.add(playhead);
        if (sound) sound->add(playhead);
    });
    for (RecordingCsv& table : tables) table.close();
    if (sound) sound->close();
    // Names may come from a hostile file: bytes that are no UTF-8 must not cost the whole report.
    if (options.json)
        write_atomic_file(
            *options.json,
            to_json(summary).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    // A user who requests the text waits for it, and ends the program if nobody takes it.
    end_on_signals();
    if (options.info) fmt::print("{}", to_text(summary));
    if (!summary.error.empty()) throw std::runtime_error(summary.error);
}

/// Shows the playhead's session to its end. `where`: a port 0 becomes the one that was found.
void show_session(Playhead& playhead, double speed, StreamingOptions& where, const std::atomic<bool>& stop,
                  LineStream& out) {
    SessionInfo session = playhead.session();
    session.protocol_major = protocol_major;
    session.protocol_minor = protocol_minor;
    session.accepts_operator = false;
    session.holds_ticks = false;
    RecordedSession shown(playhead, speed, [] { return RecordedSession::Clock::now(); });
    StreamingServer server(where, std::move(session), playhead.bone(), shown, nullptr, playhead.structures());
    server.start();
    where.port = server.port();
    out.write(fmt::format("listening on {}\n", text_of_address(where.address, where.port)));
    while (!shown.is_over() && !stop.load()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    server.stop();
    if (!shown.error().empty()) throw std::runtime_error(shown.error());
}

void go_to(Playhead& playhead, double from_s) {
    Playhead::Step step = Playhead::Step::state;
    while (step != Playhead::Step::nothing_due && step != Playhead::Step::end) step = playhead.step(from_s);
    if (step == Playhead::Step::end)
        throw std::runtime_error(
            fmt::format("--from-s {}: the recording lasts {:.3f} s", from_s, playhead.time_s()));
}

/// False if there is none.
bool go_to_next_session(Playhead& playhead) {
    for (;;) {
        const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
        if (step == Playhead::Step::new_bone) return true;
        if (step == Playhead::Step::end) return false;
    }
}

}  // namespace

void run_replay(const ReplayOptions& options, const std::atomic<bool>& stop, const ProgramOutput& output) {
    if (options.only_reads()) {
        std::string error;
        if (options.surface || options.difference) error = write_bones(options, stop);
        if (options.report) {
            Reading reading(options, stop, "report");
            speak(options.report_language);
            error = write_report(options.recording, *options.report, std::ref(reading));
            output.out->write(fmt::format("report: {}\n", (*options.report / "report.html").string()));
        }
        if (options.hdf5) {
            Reading reading(options, stop, "HDF5");
            error = write_hdf5(options.recording, *options.hdf5, options.layout, std::ref(reading));
        }
        if (options.info || options.json || options.csv || options.states_csv || options.trajectory ||
            options.sound)
            read(options, stop);
        if (!error.empty()) throw std::runtime_error(error);
        return;
    }
    StreamingOptions where = streaming_options(options.listen, options.access);
    Playhead playhead(options.recording);
    if (options.from_s > 0.0) go_to(playhead, options.from_s);
    do {
        show_session(playhead, options.speed, where, stop, *output.out);
    } while (!stop.load() && go_to_next_session(playhead));
}

}  // namespace osteomill
