#include "analysis/hdf5/recording_hdf5.h"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <variant>
#include <vector>

#include "analysis/hdf5/all_of_recording.h"
#include "analysis/hdf5/fivrs_recording.h"
#include "common/files/distinct_files.h"
#include "common/recording/recording_reader.h"

namespace osteomill {

namespace {

using Seconds = std::chrono::duration<double>;

/// By the first state, since a session that waited for a client began later than its packets' time.
double began_unix_s(const std::filesystem::path& recording) {
    RecordingReader frames(recording);
    std::optional<Stamp> first;
    try {
        while (const auto frame = frames.next()) {
            if (!first) first = frame->stamp;
            const auto* state = std::get_if<StateArrived>(&frame->event);
            if (state == nullptr) continue;
            const std::chrono::nanoseconds taken(state->state.tool.taken_unix_ns);
            if (taken.count() == 0) break;
            return Seconds(taken - (frame->stamp - *first)).count();
        }
    } catch (const RecordingError&) {
        // Who reads it comes upon this, too, and says it then.
    }
    return first ? Seconds(first->time_since_epoch()).count() : 0.0;
}

template <typename Layout>
std::string write(const std::filesystem::path& recording, Layout layout, Playhead& playhead,
                  const ReportProgress& on_frame) {
    // The report's rule: a recording is whole if it contains the session's end.
    bool has_end = false;
    std::string error = play_to_end(playhead, on_frame, [&](Playhead::Step step) {
        if (step == Playhead::Step::new_bone)
            throw std::runtime_error(recording.string() +
                                     ": several sessions were joined in it, and an HDF5 file holds one: "
                                     "cut them apart, with editcap for instance");
        has_end |= step == Playhead::Step::goodbye;
        if (step == Playhead::Step::state) layout.add(playhead);
    });
    layout.close(playhead, error.empty() && !playhead.is_truncated() && has_end);
    return error;
}

}  // namespace

std::filesystem::path fivrs_v3_file(const std::filesystem::path& file) {
    return file.parent_path() / "v3" / file.filename();
}

std::string write_hdf5(const std::filesystem::path& recording, const std::filesystem::path& file,
                       Hdf5Layout layout, const ReportProgress& on_frame) {
    std::vector<NamedFile> files{{"the recording", recording, false}, {"the HDF5 file", file}};
    if (layout == Hdf5Layout::fivrs_v3) files.push_back({"its second file", fivrs_v3_file(file)});
    require_distinct(files);
    Playhead playhead(recording);
    const double began_s = began_unix_s(recording);
    if (layout == Hdf5Layout::osteomill)
        return write(recording, AllOfRecording(file, playhead, began_s), playhead, on_frame);
    return write(recording, FivrsRecording(file, playhead, began_s, layout == Hdf5Layout::fivrs_v3), playhead,
                 on_frame);
}

}  // namespace osteomill
