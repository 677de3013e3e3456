// A viewpoint in and out of its message.
#pragma once

#include <variant>

#include "common/session/viewpoint.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::Viewpoint to_message(const Viewpoint& viewpoint);

/// Refuses an eye that is no place (patient_space.h), axes that are no rotation, and a field of view outside
/// 1 to 170 degrees.
std::variant<Viewpoint, WireError> viewpoint_from(const v2::Viewpoint& message);

}  // namespace osteomill
