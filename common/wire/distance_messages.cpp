#include "common/wire/distance_messages.h"

#include <cmath>
#include <string>

namespace osteomill {

namespace {

bool is_amount(double value) {
    return std::isfinite(value) && value >= 0.0;
}

}  // namespace

v2::StructureDistance to_message(const StructureDistance& distance) {
    v2::StructureDistance message;
    message.set_tissue(static_cast<std::uint32_t>(distance.tissue));
    if (distance.distance_mm) message.set_distance_mm(*distance.distance_mm);
    message.set_touches(distance.touches);
    message.set_touches_so_far(distance.touches_so_far);
    message.set_first_touch_s(distance.first_touch_s);
    message.set_touched_s(distance.touched_s);
    message.set_removed_mm3(distance.removed_mm3);
    message.set_entered_mm3(distance.entered_mm3);
    return message;
}

std::variant<std::vector<StructureDistance>, WireError> structure_distances_from(
    const google::protobuf::RepeatedPtrField<v2::StructureDistance>& messages, std::size_t tissue_count) {
    std::vector<StructureDistance> distances;
    std::vector<bool> is_listed(tissue_count, false);
    for (const v2::StructureDistance& message : messages) {
        if (message.tissue() >= tissue_count)
            return WireError{"a distance is of tissue " + std::to_string(message.tissue()) +
                             ", not one of the scene's " + std::to_string(tissue_count)};
        if (is_listed[message.tissue()])
            return WireError{"two distances are of tissue " + std::to_string(message.tissue())};
        is_listed[message.tissue()] = true;
        StructureDistance distance{.tissue = message.tissue(),
                                   .distance_mm = {},
                                   .touches = message.touches(),
                                   .touches_so_far = message.touches_so_far(),
                                   .first_touch_s = message.first_touch_s(),
                                   .touched_s = message.touched_s(),
                                   .removed_mm3 = message.removed_mm3(),
                                   .entered_mm3 = message.entered_mm3()};
        if (message.has_distance_mm()) distance.distance_mm = message.distance_mm();
        if (!std::isfinite(distance.distance_mm.value_or(0.0)) || !std::isfinite(distance.first_touch_s) ||
            !is_amount(distance.touched_s) || !is_amount(distance.removed_mm3) ||
            !is_amount(distance.entered_mm3))
            return WireError{"a distance to tissue " + std::to_string(message.tissue()) +
                             " comes with an impossible number"};
        distances.push_back(distance);
    }
    return distances;
}

}  // namespace osteomill
