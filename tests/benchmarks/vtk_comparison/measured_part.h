// One part of the comparison, in a process of its own: CPU time is that of one library alone.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "studies/render/full_rate/drawing_task.h"

namespace osteomill {

inline constexpr std::array<const char*, 5> part_names{"ours", "vtk-gpu", "vtk-cpu", "vtk-gpu-cropped",
                                                       "vtk-cpu-cropped"};
inline constexpr std::array<const char*, 2> view_names{"overview", "close-up"};

/// Draws `frames` full frames of each view, then as many after a change each, and writes a picture of each
/// view, from before the changes, to FOLDER/PART-VIEW.png. Returns CPU milliseconds of all threads, and of
/// the wall clock: {VIEW: {"full": {"cpu_ms": [...], "wall_ms": [...]}, "after_change": {...}}}. Throws
/// std::runtime_error for an unknown part.
nlohmann::json measure_part(const std::string& part, int frames, const std::filesystem::path& folder);

/// VTK's GPU mapper over the bone cropped to its bricks, which is all that we upload: a task of
/// `osteomill_study render --full-rate`. Writes FOLDER/vtk_PHANTOM.json (see draw_by_vtk) and .png. Throws
/// std::runtime_error where it draws nothing.
void draw_task(const study::DrawingTask& task, std::optional<int> gpu, const std::filesystem::path& folder);

/// Writes FOLDER/PART-VIEW-reference.png, samples a tenth of a voxel apart.
void draw_references(const std::string& part, const std::filesystem::path& folder);

}  // namespace osteomill
