#include "simulation/coupling/force_reconstruction.h"

#include <algorithm>

namespace osteomill {

void ForceReconstruction::add(const glm::dvec3& force_n, double now_s) noexcept {
    before_that_n_ = has_sample_ ? before_n_ : force_n;
    before_n_ = has_sample_ ? newest_n_ : force_n;
    newest_n_ = force_n;
    has_sample_ = true;

    const glm::dvec3 rendered_n = line_at(now_s);
    to_n_ = estimate();
    from_n_ = shape_ == ForceShape::line ? rendered_n : to_n_;
    arrival_s_ = now_s;
}

glm::dvec3 ForceReconstruction::estimate() const noexcept {
    switch (estimate_) {
        case ForceEstimate::trapezoid:
            return 1.5 * newest_n_ - 0.5 * before_n_;
        case ForceEstimate::corrected:
            return 2.0 * newest_n_ - 1.5 * before_n_ + 0.5 * before_that_n_;
        case ForceEstimate::newest:
            break;
    }
    return newest_n_;
}

glm::dvec3 ForceReconstruction::line_at(double time_s) const noexcept {
    const double share = std::clamp((time_s - arrival_s_) / period_s_, 0.0, 1.0);
    return from_n_ + share * (to_n_ - from_n_);
}

}  // namespace osteomill
