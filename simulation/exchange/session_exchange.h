// Data that the threads of a session hand over: the newest values through triple buffers, changes of the bone
// through ordered queues. Each has one writer and one reader.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "common/bone/bone.h"
#include "common/session/tool_state.h"
#include "simulation/exchange/change_queue.h"
#include "simulation/exchange/milling_step.h"
#include "simulation/exchange/session_gate.h"
#include "simulation/exchange/triple_buffer.h"

namespace osteomill {

struct SessionExchange {
    /// Over half a second of the heaviest carving (5 mm burr, half immersed, at 1 kHz: 6 kB a step).
    static constexpr std::size_t change_queue_bytes = std::size_t{1} << 22;
    /// The changes that a tenth of a second restores.
    static constexpr std::size_t restored_queue_bytes = std::size_t{1} << 21;

    /// Who follows a session, but for its status.
    struct Followers {
        bool consume_changes = false;
        bool control = false;  ///< the session can be paused, and strokes undone
    };

    /// `at_start`: the tool before the first tick.
    SessionExchange(const Bone& bone, const ToolState& at_start, const Followers& followers)
        : changes(followers.consume_changes ? change_queue_bytes : 0, bone.shared_content()),
          tool(at_start),
          restored(followers.control
                       ? std::make_unique<ChangeQueue>(restored_queue_bytes, bone.shared_content())
                       : nullptr),
          status(at_start) {}
    /// For the loops of a copy of a session, without clients, that goes on where `other` is. No thread may be
    /// using `other`.
    SessionExchange(const SessionExchange& other, const Bone& bone)
        : results(other.results),
          commands(other.commands),
          changes(0, bone.shared_content()),
          tool(other.tool),
          status(other.status) {}

    // Between the loops.
    TripleBuffer<MillingResult> results;  ///< milling to haptic
    TripleBuffer<BurrCommand> commands;   ///< haptic to milling

    // To streaming.
    ChangeQueue changes;           ///< by milling, in order
    TripleBuffer<ToolState> tool;  ///< by the haptic loop
    TripleBuffer<std::optional<CutState>>
        cuts;  ///< by milling, for sound; empty without a consumer of the changes

    // From streaming. `gate` goes both ways.
    SessionGate gate;
    std::unique_ptr<ChangeQueue>
        restored;  ///< to milling, applied while the spindle is off; null: not controlled
    TripleBuffer<Placement> placements;  ///< to haptic

    // To the main thread.
    TripleBuffer<ToolState> status;
};

}  // namespace osteomill
