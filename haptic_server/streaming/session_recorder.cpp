#include "haptic_server/streaming/session_recorder.h"

#include <algorithm>
#include <utility>

#include "common/files/session_file.h"
#include "common/log/log.h"
#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"

namespace osteomill {

namespace {

constexpr std::chrono::microseconds least_between_states{100};

/// A recording's packets know their length; the one before a frame on the wire is left out.
std::string packet_of(const std::string& frame, Stamp stamp) {
    FrameDecoder decoder;
    decoder.append({reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size()});
    return with_recorded_time(*decoder.next(), stamp.time_since_epoch().count());
}

Stamp later(Stamp from, double by_s) {
    return from + std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(by_s));
}

v2::Hello of_recording(v2::Hello hello, const RecordTo& to) {
    hello.set_holds_ticks(to.ticks != nullptr);
    hello.clear_records_view();
    return hello;
}

}  // namespace

SessionRecorder::SessionRecorder(const RecordTo& to, v2::Hello hello, const BoneReplica& mirror,
                                 std::span<const v2::StructureBricks> structures)
    : began_(to.began),
      session_began_(to.began),
      ticks_(to.ticks),
      outgoing_(of_recording(std::move(hello), to), mirror, packers_, structures),
      writer_(
          to.file,
          [this, on_news = to.on_news](RecordingNews news, const std::string& line) {
              if (!is_under_way_) return;
              if (news == RecordingNews::goes_on)
                  log_warning("{}", line);
              else
                  log_error("{}; the session goes on, and the recording, too, once it can be written", line);
              if (on_news) on_news(news, line);
          },
          WhenDiskIsFull::try_again) {
    hand_over(Wait::for_the_disk);
    writer_.wait_until_written();
    if (writer_.has_failed()) {
        writer_.discard();
        throw RecordingError(writer_.report().error);
    }
    is_under_way_ = true;
    if (writer_.torn()) log_warning("{}", torn_line(to.file, *writer_.torn()));
}

void SessionRecorder::begin(SessionState& state, Wait wait) {
    time_s_ = state.tool.time_s;
    if (state.tool.taken_unix_ns == 0)
        state.tool.taken_unix_ns = later(session_began_, time_s_).time_since_epoch().count();
    take_ticks(wait);
}

bool SessionRecorder::says_more(const SessionState& state) const {
    if (!last_ || !outgoing_.has_sent_all() || outgoing_.has_waiting() || has_untaken_ticks()) return true;
    return state.tool.time_s != last_->tool.time_s || state.tool.removed_mm3 != last_->tool.removed_mm3 ||
           !state.events.empty() || state.status != last_->status || state.distances != last_->distances;
}

void SessionRecorder::record(SessionState state, bool may_wait) {
    const Wait wait = may_wait ? Wait::for_the_disk : Wait::never;
    begin(state, wait);
    // Who sees it again reads what was recorded.
    state.status.recording_problem.clear();
    if (!says_more(state)) return;
    last_ = state;
    // A checksum costs its eight bytes. With one, each state is news, and whichever is the last proves the
    // bone.
    outgoing_.request_state(std::move(state), true);
    hand_over(wait);
}

void SessionRecorder::finish(SessionState state, const std::string& reason) {
    begin(state, Wait::a_moment);
    state.status.recording_problem.clear();
    for (; has_untaken_ticks() && writer_.has_room(); take_ticks(Wait::a_moment)) {
        outgoing_.request_state(state, true);
        state.events.clear();
        hand_over(Wait::a_moment);
    }
    const bool has_said_all = !says_more(state);
    if (!has_said_all) outgoing_.request_state(std::move(state), true);
    outgoing_.finish(reason, has_said_all);
    hand_over(Wait::a_moment);
    if (outgoing_.is_finished()) writer_.commit();
    writer_.finish();
}

RecordingReport SessionRecorder::report() const {
    RecordingReport report = writer_.report();
    const bool lacks_end = report.error.empty() && outgoing_.finish_requested() && !outgoing_.is_finished();
    if (lacks_end) report.error = report.file.string() + ": lacks the end: the disk was full until then";
    if (ticks_ != nullptr) report.missed_ticks = ticks_->dropped();
    return report;
}

void SessionRecorder::take_ticks(Wait wait) {
    if (ticks_ == nullptr || outgoing_.waiting_ticks() >= most_ticks_of_message) return;
    wait_for_room(wait);
    if (!writer_.has_room()) return;
    if (missed_ticks_ > 0) {
        if (outgoing_.waiting_ticks() > 0) return;
        outgoing_.note_missed_ticks(std::exchange(missed_ticks_, 0));
    }
    // A tick is dropped when the queue is full, so dropped ticks are later than all that are in it.
    const std::uint64_t dropped = ticks_->dropped();
    ticks_->consume_all([this](const TickSample& tick) { outgoing_.note_tick(tick); });
    missed_ticks_ = dropped - std::exchange(dropped_ticks_, dropped);
}

bool SessionRecorder::has_untaken_ticks() const {
    return ticks_ != nullptr && (missed_ticks_ > 0 || !ticks_->empty());
}

void SessionRecorder::wait_for_room(Wait wait) {
    if (wait == Wait::for_the_disk) writer_.wait_for_room();
    if (wait == Wait::a_moment) writer_.wait_for_room(RecordingWriter::longest_standstill);
}

void SessionRecorder::hand_over(Wait wait) {
    for (;;) {
        wait_for_room(wait);
        if (!writer_.has_room()) return;
        const std::uint64_t newest = outgoing_.newest_state();
        const std::optional<std::string> frame = outgoing_.next();
        if (!frame) return;
        Stamp stamp = std::max(later(began_, time_s_), stamp_);
        // Rows of a table have times of their own: rows that do not fit one state come a moment later.
        if (outgoing_.newest_state() != newest) {
            if (newest > 0 && stamp <= stamp_) stamp = stamp_ + least_between_states;
            stamp_ = stamp;
        }
        writer_.push(stamp, packet_of(*frame, stamp));
    }
}

}  // namespace osteomill
