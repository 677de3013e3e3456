// Position and velocity of a body in one dimension.
#pragma once

namespace osteomill::study {

struct MotionState {
    double position_m = 0.0;
    double velocity_m_per_s = 0.0;
};

}  // namespace osteomill::study
