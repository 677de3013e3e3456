// The JSON file of a run's measurements (--json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/statistics/percentile.h"
#include "render_client/volume/textures/texture_plan.h"

namespace osteomill {

/// Percentiles of the time that frames took.
class FrameTimes {
  public:
    void add(double frame_ms) { frames_ms_.push_back(frame_ms); }
    std::size_t count() const { return frames_ms_.size(); }
    /// `share` from 0 to 1; 0 without frames.
    double percentile_ms(double share) const { return percentile(frames_ms_, share); }

  private:
    std::vector<double> frames_ms_;
};

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
