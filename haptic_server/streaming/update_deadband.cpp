#include "haptic_server/streaming/update_deadband.h"

namespace osteomill {

namespace {

/// Margin for the rounding of a product of session time and frame rate.
constexpr double rounding_s = 1e-6;

}  // namespace

bool is_within_deadband(const ToolState& sent, const ToolState& now) {
    const double elapsed_s = now.time_s - sent.time_s;
    return elapsed_s >= 0.0 && elapsed_s < deadband_period_s - rounding_s && looks_the_same(sent, now);
}

}  // namespace osteomill
