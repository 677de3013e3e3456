// Frames for one client, in order: hello, a snapshot, state frames, goodbye. No sockets, no clock.
//
// The snapshot is taken from the mirror piece by piece, only as fast as the client reads, while milling goes
// on. A change to a brick that is still to be sent needs no extra message: the brick will be sent in its
// state of that time. A change to a sent brick is pending until a state frame contains it. So a client ends
// up equal to the mirror however slow it is, and costs at most one mask of changed voxels for each brick: see
// PendingChanges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/bone/brick_change.h"
#include "common/session/session_state.h"
#include "common/session/tool_state.h"
#include "common/wire/bone_comparison.h"
#include "common/wire/bone_replica.h"
#include "common/wire/ct_pieces.h"
#include "common/wire/packed_changes.h"
#include "common/wire/packed_ticks.h"
#include "common/wire/snapshot.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

/// Changes of the bone that a client has yet to be sent, brick by brick, each in its turn.
///
/// The turn goes round the grid: after a brick comes the next above it that is waiting, and after the last
/// the first. So a brick waits for each other one at most once, even if bricks before it keep changing
/// faster than the client reads.
///
/// Bounded: one entry of about 60 bytes for each stored brick that is waiting, and a mask of 512 bytes for
/// the first `most_masks` of them. Beyond these a brick is sent whole.
class PendingChanges {
  public:
    /// 2 MiB of masks: far more bricks than a burr touches while a network hiccups.
    static constexpr std::size_t most_masks = 4096;

    /// Once part of a brick was restored, all of it that waits goes as restored: the client may know older
    /// values than those from which milling went on.
    void add(const BrickChange& change);
    void add_whole(BrickIndex brick);

    bool empty() const { return waiting_.empty(); }
    std::size_t bricks() const { return waiting_.size(); }
    std::size_t masks() const { return masks_; }

    /// Whose turn it is; not to be called on an empty set.
    BrickChange next() const;
    /// The brick of next() has been sent: the turn goes on.
    void sent();

  private:
    struct Waiting {
        std::unique_ptr<VoxelMask> voxels{};  ///< null: the whole brick
        ChangeKind kind = ChangeKind::milled;
    };
    std::map<BrickIndex, Waiting>::const_iterator turn() const;

    std::map<BrickIndex, Waiting> waiting_;
    std::size_t masks_ = 0;
    BrickIndex turn_ = 0;  // bricks from here on come first
};

/// Budget of a state frame for one client, so that its link has taken it after a quarter of a second:
/// over a slow one the tool is sent often, and the bone piece by piece, rather than all of it late.
class FramePace {
  public:
    /// A larger frame keeps the next ones waiting: this is a second of a link of 256 kbit/s.
    static constexpr std::size_t most = 32 * 1024;
    /// Less would be mostly the tool.
    static constexpr std::size_t least = 2 * 1024;
    static constexpr double longest_s = 0.25;

    std::size_t most_bytes() const { return most_bytes_; }

    /// Reports that the link took `took_s` for a frame of `bytes`. If that was too long, the next frame is
    /// shorter in proportion. If the frame used half of its length or more and took less than half of the
    /// time, the next may be twice as long.
    void wrote(std::size_t bytes, double took_s) {
        if (took_s > longest_s) {
            const double fits = static_cast<double>(bytes) * longest_s / took_s;
            most_bytes_ = std::clamp(static_cast<std::size_t>(fits), least, most_bytes_);
        } else if (2 * bytes >= most_bytes_ && took_s < 0.5 * longest_s) {
            most_bytes_ = std::min(2 * most_bytes_, most);
        }
    }

  private:
    std::size_t most_bytes_ = most;
};

/// Buffers to compress in, which all OutgoingFrames of a thread share.
struct FramePackers {
    SnapshotPacker snapshot;
    ChangePacker changes;
    TickPacker ticks;
};

/// A tool that rests is sent this often, in session time: often enough for a viewer that waits for its
/// clock to go on.
inline constexpr double deadband_period_s = 0.1;

/// Whether `now` need not be sent after `sent`: it looks the same and comes less than a period later.
bool is_within_deadband(const ToolState& sent, const ToolState& now);

class OutgoingFrames {
  public:
    /// `hello` is the client's first frame, `structures` are the messages of the protected structures, sent
    /// after the snapshot. All but `hello` outlive this object.
    OutgoingFrames(v2::Hello hello, const BoneReplica& mirror, FramePackers& packers,
                   std::span<const v2::StructureBricks> structures = {});

    /// To be called for every change of the mirror, before the next frame is requested.
    void note(std::span<const BrickChange> changes);

    /// Requests a state frame as soon as one can be sent; but if nothing is new and the tool rests, only
    /// every deadband_period_s. A frame that has not been sent yet is replaced; its changes of the bone go
    /// with the next one. A requested checksum goes with the first frame after which the client has all
    /// changes. Events wait until they are sent; for a client that does not read, the oldest beyond
    /// most_waiting_events are dropped.
    void request_state(SessionState state, bool with_checksum);

    /// Ticks for a recording: they go with the next state, or the next few.
    void note_tick(const TickSample& tick) { ticks_.push_back(tick); }
    /// So many ticks should follow those noted so far, and were lost.
    void note_missed_ticks(std::uint64_t missed) { missed_ticks_ += missed; }
    /// Changes, events, ticks or their loss are yet to be sent.
    bool has_waiting() const {
        return !pending_.empty() || !events_.empty() || !ticks_.empty() || missed_ticks_ > 0;
    }
    /// Those that are yet to be sent.
    std::size_t waiting_ticks() const { return ticks_.size(); }

    /// An answer for this client alone, sent with its next state.
    void tell(const ControlEvent& event) { events_.push_back(event); }

    /// The client requests the CT; a second request has no effect.
    void ask_for_ct() { wants_ct_ = true; }
    /// Whether it waits for give_ct().
    bool wants_ct() const { return wants_ct_ && !ct_; }
    /// Its pieces go between the states.
    void give_ct(std::shared_ptr<const CtVolume> ct) { ct_ = std::move(ct); }

    /// The client doubts its bone. The next state frame answers, and differing bricks are sent like changes.
    /// An error, which drops the client: it has no bone yet, or asks before the previous answer, more often
    /// than a repair needs, or with invalid ranges.
    std::optional<WireError> compare(const v2::CompareBone& request);

    /// Requests the end: the remaining changes, a last state with a checksum, then goodbye; goodbye at once
    /// if the last state contained everything (`has_said_all`).
    void finish(std::string reason, bool has_said_all = false);

    /// The next frame, as bytes for the stream; nothing while there is nothing to send. Changes that exceed a
    /// state frame of so many bytes follow in the next; each frame contains at least one brick.
    std::optional<std::string> next(std::size_t most_state_bytes = FramePace::most);

    bool finish_requested() const { return goodbye_.has_value(); }
    /// Whether goodbye has been sent.
    bool is_finished() const { return stage_ == Stage::finished; }

    /// The number of the newest state frame; 0: none yet.
    std::uint64_t newest_state() const { return newest_state_; }
    /// Whether that frame contains everything that was new when a state was last requested.
    bool has_sent_all() const { return newest_state_ > 0 && !wants_state_; }

    /// The changes that wait for the client.
    const PendingChanges& pending() const { return pending_; }

  private:
    static constexpr std::size_t most_waiting_events = 1000;
    /// Two searches of the longest kind; after that one for each state frame.
    static constexpr int most_comparisons_at_once = 2 * most_requests_of_a_search;

    enum class Stage { hello, snapshot_begin, snapshot_bricks, snapshot_end, live, finished };

    void fill_snapshot_bricks(v2::SnapshotBricks& message);
    void fill_state(v2::StateFrame& state, std::size_t most_bytes);
    void add_changes(v2::StateFrame& state, std::size_t most_bytes);
    void add_events(v2::StateFrame& state, std::size_t most_bytes);
    void add_ticks(v2::StateFrame& state);

    v2::Hello hello_;
    const BoneReplica& mirror_;
    FramePackers& packers_;
    Stage stage_ = Stage::hello;
    std::uint64_t sequence_ = 0;
    std::uint64_t newest_state_ = 0;

    std::size_t next_slot_ = 0;  // bricks of lower slots have been sent
    std::uint64_t snapshot_checksum_ = 0;

    PendingChanges pending_;
    std::optional<v2::Comparison> answer_;
    int comparisons_left_ = most_comparisons_at_once;

    bool wants_ct_ = false;
    std::shared_ptr<const CtVolume> ct_;  // stays, so that it is not asked for again
    std::size_t next_ct_voxel_ = 0;
    std::optional<CtPacker> ct_packer_;

    std::deque<ControlEvent> events_;  // that have yet to be sent

    std::vector<TickSample> ticks_;  // that have yet to be sent
    std::uint64_t missed_ticks_ = 0;

    std::span<const v2::StructureBricks> structure_pieces_;  // that have yet to be sent

    SessionState state_;  // the newest; its events are among those above
    std::optional<SessionState> sent_;
    bool wants_state_ = false;
    bool wants_checksum_ = false;
    std::optional<std::string> goodbye_;
};

}  // namespace osteomill
