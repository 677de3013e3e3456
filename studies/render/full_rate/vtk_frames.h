// The same bone drawn by VTK's GPU mapper, in a process of its own: the benchmark vtk_comparison, which is
// built where libvtk9-dev is installed, and lies beside this program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "studies/render/full_rate/drawing_task.h"
#include "studies/render/full_rate/finished_frames.h"

namespace osteomill::study {

/// Where it is; nothing where it was not built.
std::optional<std::filesystem::path> vtk_program();

struct VtkFrames {
    std::string gl_renderer{};
    FrameMilliseconds orbit{};
    FrameMilliseconds carve{};
};

/// Frames of the bone alone, without tool and panels, cropped to its bricks. Leaves the task and a picture in
/// `folder`. `gpu` as of OffscreenContext. Throws std::runtime_error with what the program said where it
/// failed.
VtkFrames draw_by_vtk(const std::filesystem::path& program, const DrawingTask& task, std::optional<int> gpu,
                      const std::filesystem::path& folder);

}  // namespace osteomill::study
