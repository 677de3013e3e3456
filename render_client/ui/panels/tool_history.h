// The last seconds of forces, depth and removed volume, for the live plot.
#pragma once

#include <deque>
#include <optional>

#include "common/session/tool_state.h"

namespace osteomill {

/// The tool's states in the newest frames, oldest first. A frame whose time is not later than the one before
/// is left out; one that is earlier starts a new session and clears the history.
class ToolHistory {
  public:
    static constexpr double kept_s = 10.0;

    struct Sample {
        double time_s = 0.0;
        glm::dvec3 force_n{0.0};
        std::optional<double> depth_mm{};
        double removed_mm3 = 0.0;
    };

    void add(const ToolState& tool);
    const std::deque<Sample>& samples() const { return samples_; }

  private:
    std::deque<Sample> samples_;
};

}  // namespace osteomill
