#include "render_client/ui/view/frame_times.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

double FrameTimes::percentile_ms(double part) const {
    if (frames_ms_.empty()) return 0.0;
    const auto count = static_cast<double>(frames_ms_.size());
    const double rank = std::clamp(std::ceil(part * count), 1.0, count);
    std::vector<double> sorted = frames_ms_;
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::nth_element(sorted.begin(), place, sorted.end());
    return *place;
}

}  // namespace osteomill
