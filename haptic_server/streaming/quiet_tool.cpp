#include "haptic_server/streaming/quiet_tool.h"

namespace osteomill {

namespace {

/// Room for what a product of session time and frame rate rounds off.
constexpr double rounding_s = 1e-6;

}  // namespace

bool is_quiet(const ToolView& told, const ToolView& now) {
    const double elapsed_s = now.time_s - told.time_s;
    return elapsed_s >= 0.0 && elapsed_s < quiet_period_s - rounding_s && looks_the_same(told, now);
}

}  // namespace osteomill
