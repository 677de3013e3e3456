// Budget of a state frame for one client, so that its link has taken it after a quarter of a second:
// over a slow one the tool is sent often, and the bone piece by piece, rather than all of it late.
#pragma once

#include <algorithm>
#include <cstddef>

namespace osteomill {

class FramePace {
  public:
    /// A larger frame keeps the next ones waiting: this is a second of a link of 256 kbit/s.
    static constexpr std::size_t most = 32 * 1024;
    /// Less would be mostly the tool.
    static constexpr std::size_t least = 2 * 1024;
    static constexpr double longest_s = 0.25;

    std::size_t most_bytes() const { return most_bytes_; }

    /// Reports that the link took `took_s` for a frame of `bytes`. If that was too long, the next frame is
    /// shorter in proportion. If the frame used half of its length or more and took less than half of the
    /// time, the next may be twice as long.
    void wrote(std::size_t bytes, double took_s) {
        if (took_s > longest_s) {
            const double fits = static_cast<double>(bytes) * longest_s / took_s;
            most_bytes_ = std::clamp(static_cast<std::size_t>(fits), least, most_bytes_);
        } else if (2 * bytes >= most_bytes_ && took_s < 0.5 * longest_s) {
            most_bytes_ = std::min(2 * most_bytes_, most);
        }
    }

  private:
    std::size_t most_bytes_ = most;
};

}  // namespace osteomill
