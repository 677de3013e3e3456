// Percentiles of the time that frames took.
#pragma once

#include <vector>

namespace osteomill {

class FrameTimes {
  public:
    void add(double frame_ms) { frames_ms_.push_back(frame_ms); }
    std::size_t count() const { return frames_ms_.size(); }
    /// The smallest time that at least `part` (0 to 1) of the frames did not exceed (nearest rank); 0 without
    /// frames.
    double percentile_ms(double part) const;

  private:
    std::vector<double> frames_ms_;
};

}  // namespace osteomill
