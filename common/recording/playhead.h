// A place in a recording and the session as it was there: its bone, its tool. Moves forward frame by frame.
#pragma once

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "common/program/progress.h"
#include "common/recording/recording_reader.h"
#include "common/wire/session_receiver.h"

namespace osteomill {

/// How much has been read.
struct RecordingCounts {
    std::uint64_t frames = 0;  ///< all kinds; a packet each
    std::uint64_t states = 0;
    std::uint64_t bytes = 0;
    std::uint64_t state_bytes = 0;   ///< in the state frames; nearly all others are the snapshot's
    std::uint64_t ticks = 0;         ///< ticks of the haptic loop; 0 if the recording holds none
    std::uint64_t missed_ticks = 0;  ///< ticks that should be there
    std::uint64_t tick_bytes = 0;    ///< the ticks' part of the state frames
    std::uint64_t checksums_verified = 0;
};

class Playhead {
  public:
    /// Goes to the first bone. Throws RecordingError if there is none.
    explicit Playhead(std::filesystem::path file);

    enum class Step {
        nothing_due,  ///< the next frame is later
        state,        ///< a state frame was applied: see state()
        new_bone,     ///< another session began
        goodbye,      ///< the session ended; another may begin, in a recording that was joined
        end,
    };
    /// Takes the next frame (a snapshot whole) unless it is later than `until_s`. Every checksum that is
    /// stated is verified. Throws RecordingError, with packet and byte, for bad contents.
    Step step(double until_s);

    /// The last frame's time, since the first; never goes back within a recording.
    double time_s() const { return time_s_; }
    /// The time of the frame that step() would read; nothing at the end, or if that frame cannot be read.
    std::optional<double> next_time_s() const;
    const SessionInfo& session() const { return session_; }
    const Bone& bone() const { return replica_->bone(); }
    std::uint64_t bone_checksum() const { return replica_->checksum(); }
    /// The changes of the bone since the last call, or since the bone came.
    std::vector<BrickChange> take_changes() { return replica_->take_changes(); }
    /// Nothing before the session's first state frame.
    const ToolState* tool() const { return has_state_ ? &state_.tool : nullptr; }
    /// The last state frame's content; empty before the first.
    const SessionState& state() const { return state_; }
    /// The protected structures of the session whose place the recording states; the others are where the
    /// bone has their label. All that follow the bone at once are there with it.
    const std::vector<Structure>& structures() const { return structures_; }
    /// The haptic loop's ticks between the last state frame but one and the last; none in a recording that
    /// does not hold them.
    const std::vector<TickSample>& ticks() const { return ticks_.ticks; }
    /// The changes of the state frame applied last; and of the next one, if the next is a state frame.
    const std::vector<ChangedBrick>& changes() const { return changes_; }
    const StateArrived* next_state() const;
    /// Whether step() would leave this session for another.
    bool next_begins_session() const;

    /// Since the recording was opened.
    const RecordingCounts& counts() const { return counts_; }
    /// The share of the file that has been read, 0 to 1.
    double share_read() const {
        return std::min(1.0, static_cast<double>(counts_.bytes) / static_cast<double>(file_bytes_));
    }
    /// At the end: whether the file ends within a packet.
    bool is_truncated() const { return reader_.is_truncated(); }

    /// A place to come back to, as long as the session is the same.
    struct Mark {
        RecordingReader::Mark place;
        RecordedTime time;
        double time_s = 0.0;
        SessionState state;
        bool has_state = false;
    };
    Mark mark() const { return {before_next_, before_next_time_, time_s_, state_, has_state_}; }
    /// The bone is the caller's to put back, with set_fractions().
    void go_back_to(const Mark& mark);
    void set_fractions(BrickIndex brick, BrickFractions fractions) {
        replica_->set_fractions(brick, fractions);
    }

  private:
    void read_ahead();
    Step take(RecordedEvent event);
    void take_structures();

    RecordingReader reader_;
    RecordingReader::Mark before_next_;
    std::optional<RecordedEvent> next_;
    std::optional<RecordingError> what_comes_next_is_wrong_;  // reported when its turn comes
    RecordedTime before_next_time_;
    RecordedTime time_;    // for next_
    double time_s_ = 0.0;  // time of the last frame

    SessionInfo announced_;  // becomes session_ when its bone has come
    SessionInfo session_;
    std::optional<BoneReplica> replica_;
    SessionState state_;
    bool has_state_ = false;
    TickBlock ticks_;
    std::vector<ChangedBrick> changes_;
    std::vector<Structure> structures_;

    RecordingCounts counts_;
    std::uint64_t file_bytes_ = 1;
};

/// Takes all remaining steps: `on_frame(share_read())` before each, `on_step(step)` after each but the end.
/// Returns why the recording cannot be read to its end, empty if it can; everything before that stays valid.
/// Passes on exceptions of the two callbacks, except RecordingError.
template <typename OnFrame, typename OnStep>
std::string play_to_end(Playhead& playhead, const OnFrame& on_frame, const OnStep& on_step) {
    try {
        for (;;) {
            on_frame(playhead.share_read());
            const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::end) return {};
            on_step(step);
        }
    } catch (const RecordingError& error) {
        return error.what();
    }
}

// The bone of a recording at the beginning and at the end, for results that need both.

/// The bones of a recording; if recordings were joined, those of the last session.
struct RecordedBones {
    Bone at_start;        ///< as it was when the recording began
    Bone at_end;          ///< after the last frame that can be read
    std::string error{};  ///< why it is not read further; empty at the end
};

/// Reads a recording through, every checksum with it; `on_frame` is called before each. Throws RecordingError
/// if there is no bone in it; later faults are reported in `error`.
RecordedBones bones_of(const std::filesystem::path& file, const ReportProgress& on_frame);

}  // namespace osteomill
