// Runner of a session's controls by its operator: pause, undo and redo by slices of strokes, marks, the speed
// of the spindle, fixtures on and off, saving, the end. They run on the streaming thread, whose own copy of
// the bone shows everything that was milled.
//
// Undo takes the path of milling in reverse: the fractions in the journal are queued for the milling loop,
// which writes them into its bone while the spindle is off; they return as changes that restore, for the copy
// of the bone, every client and the recording. Meanwhile the session holds still. All that is undone and
// redone in one frame is one change of the bone, even a thousand strokes. Before the session goes on, the
// tool is lifted out of the restored bone. A command that must wait for this, for the end of a stroke or for
// the arm waits in line, a second at most: then it is refused, with the reason.
//
//     asks    the window (render_client/ui/input/commands.h; its panels leave SessionRequests there), another
//             client, or a script (control_script.h): each a SessionControl (session_control.h).
//             leases.h decides which client may
//     acts    ControlRunner, here; the loops through SessionGate (simulation/exchange/session_gate.h) and
//             the queue of restored changes
//     writes  SaveAndFinish (haptic_server/session/save_and_finish.h) the saved bone, and it ends the session
//     told    ControlEvents, to every client and the recording; the window words them by ControlNotices
//             (render_client/ui/input/commands.h)
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/session/session_control.h"
#include "common/session/stroke_span.h"
#include "common/session/tool_state.h"
#include "common/wire/bone_replica.h"
#include "haptic_server/streaming/stroke_journal.h"
#include "simulation/exchange/change_queue.h"
#include "simulation/exchange/session_gate.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

class ControlRunner {
  public:
    /// Actions of other parts. Each returns the reason why it cannot be done; an empty line: it will be done.
    struct Requests {
        /// `text`: the kind of file; empty for the bone itself.
        std::function<std::string(const Bone&, const std::string& text)> save{};
        std::function<std::string()> finish{};
        /// The failures to save since the last call, a line each. The function may be empty.
        std::function<std::vector<std::string>()> save_news{};
        /// Why nothing is recorded at present, one line; empty while all is well. The function may be empty.
        std::function<std::string()> recording_problem{};
        /// The answer to Finish, such as where the report will be.
        std::string finish_words{};
        /// The pose of a burr that is to be placed there, or the reason of a refusal. Empty if tools cannot
        /// be placed.
        std::function<std::variant<ToolPose, std::string>(const Bone&, const ToolPose&, std::size_t burr)>
            place{};
        /// A pose clear of bone, if the burr is inside bone, which undo may have restored around it. Empty if
        /// tools cannot be placed.
        std::function<std::optional<ToolPose>(const Bone&, const ToolPose&, std::size_t burr)> lift_out{};
        /// Called when the burr is there.
        std::function<void(const ToolPose&)> placed{};
        /// Names of the scene's fixtures in their order; empty for one that cannot be switched.
        std::vector<std::string> fixtures{};
    };
    /// Most requests that wait; more are refused.
    static constexpr std::size_t most_waiting = 64;
    /// At a streaming server's 30 Hz the client has its answer in less than a second.
    static constexpr int longest_wait_frames = 25;

    /// The one writer of gate.stillness, gate.spindle_rpm and gate.fixtures_on, of `restored` and of
    /// `placements`; all outlive it.
    ControlRunner(SessionGate& gate, ChangeQueue& restored, TripleBuffer<Placement>& placements,
                  Requests requests)
        : gate_(gate), restored_(restored), placements_(placements), requests_(std::move(requests)) {}

    void control(const SessionControl& control);

    /// Before the milling loop's changes of this frame are taken over.
    void begin_frame();
    /// For each of them, before it is applied to `bone`.
    void note(const BrickChange& change, const Bone& bone);
    /// When all are: carries out the requests that are possible now, and refuses those that have waited too
    /// long.
    void end_frame(const Bone& bone, const ToolState& tool);

    std::vector<ControlEvent> take_events() { return std::exchange(events_, {}); }
    SessionStatus status() const;

  private:
    struct Waiting {
        SessionControl control;
        int frames = 0;          ///< it has seen since it was requested
        bool lifts_out = false;  ///< a placement that nobody asked for
    };
    /// The reason to wait; empty: it is done, or refused.
    std::string act(const Waiting& waiting, const Bone& bone, const ToolState& tool);
    std::string restore(SessionAction action, const Bone& bone, const ToolState& tool);
    std::string place(const Waiting& waiting, const Bone& bone, const ToolState& tool);
    void lift_out(const Bone& bone, const ToolState& tool);
    void ask_for(const Placement& placement);
    void say_placed(const Waiting& waiting);
    void choose_speed(const SessionControl& control);
    void switch_fixture(const SessionControl& control);
    void queue_restored();
    bool is_restoring() const { return !waits_for_room_.empty() || confirmed_ < queued_; }
    bool is_bone_whole() const { return !is_restoring() && restoration_.empty(); }
    void say(const SessionControl& control, std::string refusal = {});

    SessionGate& gate_;
    ChangeQueue& restored_;
    TripleBuffer<Placement>& placements_;
    Requests requests_;
    StrokeJournal journal_;
    StrokeSpan stroke_;
    UndoSlice slice_;

    std::deque<Waiting> waiting_;
    std::vector<ControlEvent> events_;
    double time_s_ = 0.0;
    bool is_paused_ = false;
    bool has_changes_ = false;  // in this frame

    Placement placement_;  // the last that was requested
    bool is_being_placed_ = false;
    bool may_be_in_bone_ = false;             // since bone came back
    StrokeJournal::Restoration restoration_;  // this frame's
    std::deque<StrokeJournal::Restored> waits_for_room_;
    std::uint64_t queued_ = 0;     // bricks since the start
    std::uint64_t confirmed_ = 0;  // the part of queued_ that is in the bone
};

}  // namespace osteomill
