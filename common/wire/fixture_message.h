// A scene's fixtures, in and out of a hello.
#pragma once

#include <variant>
#include <vector>

#include "common/scene/fixture.h"
#include "common/wire/wire_error.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::FixtureDescription to_message(const Fixture& fixture);

/// Fixtures as a client knows them: their springs and dampers are not sent, and the usual ones here. One of a
/// shape that only a later version knows is about no tissue. Refuses more than most_fixtures, a name that is
/// too long, and places, directions and lengths that cannot be.
std::variant<std::vector<Fixture>, WireError> fixtures_from(
    const google::protobuf::RepeatedPtrField<v2::FixtureDescription>& messages);

}  // namespace osteomill
