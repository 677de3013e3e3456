#include "analysis/replay/recorded_bones.h"

#include <utility>

#include "common/recording/playhead.h"

namespace osteomill {

RecordedBones bones_of(const std::filesystem::path& file, const ReportProgress& on_frame) {
    Playhead playhead(file);
    Bone at_start = playhead.bone();
    std::string error = play_to_end(playhead, on_frame, [&](Playhead::Step step) {
        if (step == Playhead::Step::new_bone) at_start = playhead.bone();
    });
    return {.at_start = std::move(at_start), .at_end = playhead.bone(), .error = std::move(error)};
}

}  // namespace osteomill
