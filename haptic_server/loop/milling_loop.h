// One step of the milling loop: the newest command in, the model's step, result and edits out.
#pragma once

#include "haptic_server/exchange/triple_buffer.h"
#include "haptic_server/loop/edit_queue.h"
#include "haptic_server/milling/milling_model.h"
#include "haptic_server/milling/milling_step.h"

namespace osteomill {

class MillingLoop {
  public:
    /// All of it outlives the loop.
    MillingLoop(MillingModel& model, TripleBuffer<BurrCommand>& commands,
                TripleBuffer<MillingResult>& results, EditQueue& edits)
        : model_(model), commands_(commands), results_(results), edits_(edits) {}

    /// The step that ends at session time `time_s` and lasted `elapsed_s` since the last. Before the first
    /// command there is nothing to do. Real-time safe.
    void step(double time_s, double elapsed_s) noexcept {
        has_command_ |= commands_.refresh();
        if (!has_command_) return;
        BurrCommand command = commands_.front();
        command.elapsed_s = elapsed_s;
        model_.step(command, time_s, edits_, results_.back());
        results_.publish();
        edits_.resend_overflowed(model_.bone());
    }

  private:
    MillingModel& model_;
    TripleBuffer<BurrCommand>& commands_;
    TripleBuffer<MillingResult>& results_;
    EditQueue& edits_;
    bool has_command_ = false;
};

}  // namespace osteomill
