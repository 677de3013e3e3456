#include "python/module/opened_recording.h"

#include "python/module/tick_columns.h"

namespace osteomill::python {

namespace {

void add(StateColumns& columns, const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    columns.time_s.push_back(playhead.time_s());
    columns.session_time_s.push_back(tool.time_s);
    push(columns.hand_mm, tool.hand_position_mm);
    push(columns.burr_mm, tool.burr_position_mm);
    push(columns.axis, tool.spindle_axis);
    push(columns.force_n, tool.force_n);
    columns.depth_mm.push_back(tool.depth_mm.value_or(0.0));
    columns.removed_mm3.push_back(tool.removed_mm3);
    columns.burr.push_back(static_cast<std::uint8_t>(tool.burr));
    columns.spindle_on.push_back(tool.spindle_on ? 1 : 0);
}

}  // namespace

std::vector<TickSample> ticks_of(const std::filesystem::path& file) {
    std::vector<TickSample> all;
    Playhead playhead(file);
    play_to_end(
        playhead, [](double) {},
        [&](Playhead::Step step) {
            if (step != Playhead::Step::state) return;
            all.insert(all.end(), playhead.ticks().begin(), playhead.ticks().end());
        });
    return all;
}

void OpenedRecording::read() {
    if (summary_) return;
    StateColumns columns;
    summary_ = summarise(file_, [&](const Playhead& playhead) { add(columns, playhead); });
    columns_ = std::move(columns);
}

const Bone& OpenedRecording::bone_at(double time_s) {
    if (playhead_->time_s() > time_s) playhead_.emplace(file_);
    for (;;) {
        const Playhead::Step step = playhead_->step(time_s);
        if (step == Playhead::Step::nothing_due || step == Playhead::Step::end) return playhead_->bone();
    }
}

}  // namespace osteomill::python
