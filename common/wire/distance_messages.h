// How far the burr is from protected structures, in and out of messages.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "common/session/structure_distance.h"
#include "common/wire/frame.h"
#include "osteomill/v2/session.pb.h"

namespace osteomill {

v2::StructureDistance to_message(const StructureDistance& distance);

/// Refuses a tissue that is not one of so many or comes twice, and numbers that are not finite or, of times
/// and volumes, below zero.
std::variant<std::vector<StructureDistance>, WireError> structure_distances_from(
    const google::protobuf::RepeatedPtrField<v2::StructureDistance>& messages, std::size_t tissue_count);

}  // namespace osteomill
