// A scene's plan, its rating and its fixtures, in and out of a hello.
#pragma once

#include <variant>
#include <vector>

#include "common/scene/fixture.h"
#include "common/scene/plan.h"
#include "common/scene/rating.h"
#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::Plan to_message(const Plan& plan);

/// Refuses a plan without a region, and lengths that are not finite or, of a radius, not above zero.
std::variant<Plan, WireError> plan_from(const v2::Plan& message);

v2::RatingItem to_message(const RatingItem& item);

/// Refuses more items and longer texts than rating.h allows, points outside 0 to most_rating_points, and
/// regions as plan_from does. Conditions are not read: a later version may use quantities that this one does
/// not know, and then an item stays undecided.
std::variant<Rating, WireError> rating_from(
    const google::protobuf::RepeatedPtrField<v2::RatingItem>& messages);

v2::FixtureDescription to_message(const Fixture& fixture);

/// Fixtures as a client knows them: their springs and dampers are not sent, and the usual ones here. One of a
/// shape that only a later version knows is about no tissue. Refuses more than most_fixtures, a name that is
/// too long, and places, directions and lengths that cannot be.
std::variant<std::vector<Fixture>, WireError> fixtures_from(
    const google::protobuf::RepeatedPtrField<v2::FixtureDescription>& messages);

}  // namespace osteomill
