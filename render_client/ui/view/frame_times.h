// Percentiles of the time that frames took.
#pragma once

#include <vector>

#include "common/statistics/percentile.h"

namespace osteomill {

class FrameTimes {
  public:
    void add(double frame_ms) { frames_ms_.push_back(frame_ms); }
    std::size_t count() const { return frames_ms_.size(); }
    /// `share` from 0 to 1; 0 without frames.
    double percentile_ms(double share) const { return percentile(frames_ms_, share); }

  private:
    std::vector<double> frames_ms_;
};

}  // namespace osteomill
