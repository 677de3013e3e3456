// A scene's plan, in and out of a hello.
#pragma once

#include <variant>

#include "common/scene/plan.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::Plan to_message(const Plan& plan);

/// Refuses a plan without a region, and lengths that are not finite or, of a radius, not above zero.
std::variant<Plan, WireError> plan_from(const v2::Plan& message);

}  // namespace osteomill
