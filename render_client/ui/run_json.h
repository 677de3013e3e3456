// The JSON file of a run's measurements (--json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "render_client/ui/view/frame_times.h"
#include "render_client/volume/textures/texture_plan.h"

namespace osteomill {

struct RenderReport {
    FrameTimes frame_times;
    std::string gl_renderer;
    std::uint64_t bone_checksum = 0;      ///< checksum of the bone as it was last drawn
    std::optional<TexturePlan> textures;  ///< how the bone is held; absent: there is none
    std::uint64_t dirty_bricks_uploaded = 0;
    std::uint64_t checksum_mismatches = 0;
    std::string link_status;
};

/// Keys: frames (that were drawn: a still scene is not drawn again), frame_ms {p50, p99, max}, gl_renderer,
/// bone_checksum (16 hex digits), bone_textures {layout: "dense" or "atlas", coarsening, mib} (null without a
/// bone), dirty_bricks_uploaded, checksum_mismatches, link_status.
std::string to_json(const RenderReport& report);

/// Replaces the file as a whole. Throws std::runtime_error naming the file if it cannot be written.
void write_report(const RenderReport& report, const std::filesystem::path& file);

}  // namespace osteomill
