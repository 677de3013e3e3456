// Recorder of a session, which acts as one more client: a client's frames go into a file.
//
// It uses OutgoingFrames like any client, so on a slow disk changes are merged and sent later, and the
// streaming thread never waits. A full disk acts like a slow one: the session goes on, and once there is
// space the next frame contains all changes since. Poses of that time are missing, bone is not. Ticks wait in
// their queue until it is full; lost ticks are counted.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/recording/recording_writer.h"
#include "haptic_server/streaming/outgoing_frames.h"
#include "haptic_server/streaming/streaming_options.h"

namespace osteomill {

class SessionRecorder {
  public:
    /// Writes hello, snapshot and `structures` before it returns, and throws RecordingError if that much
    /// cannot be written. `mirror`, `structures` and the queue of ticks outlive the recorder.
    SessionRecorder(const RecordTo& to, v2::Hello hello, const BoneReplica& mirror,
                    std::span<const v2::StructureBricks> structures = {});

    /// Sets the wall clock at which the session's time is zero, where that was not known when the recording
    /// began. Packets keep to the time that they were given, so that a playback does not wait.
    void session_began(Stamp at) { session_began_ = at; }
    /// These work as for a client: see OutgoingFrames.
    void note(std::span<const BrickChange> changes) { outgoing_.note(changes); }
    /// Hands over a state frame with a checksum; without waiting, unless `may_wait`. Does nothing if the
    /// state equals the one before, time included.
    void record(SessionState state, bool may_wait);
    /// Hands over the end, waits until all is written and makes it the file that was requested. Gives up on a
    /// disk that does not answer (see RecordingWriter).
    void finish(SessionState state, const std::string& reason);

    /// Its error also tells if the end is missing. The recorded frames then stay in the part.
    RecordingReport report() const;

  private:
    enum class Wait { never, a_moment, for_the_disk };
    void begin(SessionState& state, Wait wait);
    bool says_more(const SessionState& state) const;
    void take_ticks(Wait wait);
    bool has_untaken_ticks() const;
    void wait_for_room(Wait wait);
    void hand_over(Wait wait);

    const Stamp began_;
    Stamp session_began_;
    SampleQueue<TickSample>* const ticks_;
    std::uint64_t missed_ticks_ = 0;  // that ticks_ dropped and the recording has yet to count
    std::uint64_t dropped_ticks_ = 0;
    std::atomic<bool> is_under_way_{false};
    // The recorder has packers of its own: the recording ends on another thread while clients are still sent
    // the end.
    FramePackers packers_{};
    OutgoingFrames outgoing_;
    RecordingWriter writer_;
    double time_s_ = 0.0;
    std::optional<SessionState> last_;  // that was handed over
    Stamp stamp_{};                     // the last state's
};

}  // namespace osteomill
