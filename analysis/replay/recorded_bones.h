// The bone of a recording at the beginning and at the end, for results that need both.
#pragma once

#include <filesystem>
#include <string>

#include "common/bone/bone.h"
#include "common/program/progress.h"

namespace osteomill {

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
