// A scene's rating, in and out of a hello.
#pragma once

#include <variant>

#include "common/scene/rating.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::RatingItem to_message(const RatingItem& item);

/// Refuses more items and longer texts than rating.h allows, points outside 0 to most_rating_points, and
/// regions as plan_from does. Conditions are not read: a later version may use quantities that this one does
/// not know, and then an item stays undecided.
std::variant<Rating, WireError> rating_from(
    const google::protobuf::RepeatedPtrField<v2::RatingItem>& messages);

}  // namespace osteomill
