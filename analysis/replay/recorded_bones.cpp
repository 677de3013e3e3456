#include "analysis/replay/recorded_bones.h"

#include <limits>

#include "common/recording/playhead.h"

namespace osteomill {

RecordedBones bones_of(const std::filesystem::path& file, const std::function<void()>& on_frame) {
    Playhead playhead(file);
    Bone at_start = playhead.bone();
    std::string error;
    try {
        for (;;) {
            on_frame();
            const Playhead::Step step = playhead.step(std::numeric_limits<double>::infinity());
            if (step == Playhead::Step::end) break;
            if (step == Playhead::Step::new_bone) at_start = playhead.bone();
        }
    } catch (const RecordingError& what) {
        error = what.what();
    }
    return {.at_start = std::move(at_start), .at_end = playhead.bone(), .error = std::move(error)};
}

}  // namespace osteomill
