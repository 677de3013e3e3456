// Distance of the burr from a protected structure, with its touches and losses so far. Plain data; on the
// wire it is the message of that name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/scene/scene.h"

namespace osteomill {

/// A touch that ends for less than this counts as going on.
inline constexpr double touch_gap_s = 0.5;

/// Structures farther than this from the burr get no distance.
inline double watched_mm(const Tissue& tissue) {
    return std::max(3.0, 2.0 * tissue.warn_mm);
}

struct StructureDistance {
    std::size_t tissue = 0;  ///< index in the session's tissues
    /// From the burr's head to the structure; 0 and below: they overlap, so deep. Nothing: further than
    /// watched_mm().
    std::optional<double> distance_mm{};
    bool touches = false;              ///< they overlap, or bone of it was milled since the state before
    std::uint32_t touches_so_far = 0;  ///< spells of it, since the session began
    double first_touch_s = 0.0;        ///< session time, of the first spell
    double touched_s = 0.0;            ///< in all
    double removed_mm3 = 0.0;          ///< bone of it that was milled and not given back
    double entered_mm3 = 0.0;          ///< of it, bone or not, where the burr's head has been

    bool operator==(const StructureDistance&) const = default;
};

/// Gravity of a warning of a protected structure; the graver the greater.
enum class StructureWarning : std::uint8_t { none, near, touch };

/// Near: closer than the tissue's warn_mm.
StructureWarning warning_of(const StructureDistance& now, const Tissue& tissue);
/// Gravest of all warnings; `tissues` are the session's.
StructureWarning gravest_warning(std::span<const StructureDistance> distances,
                                 std::span<const Tissue> tissues);

/// The structure that the burr touches or is nearest to; null if none has a distance.
const StructureDistance* nearest_structure(std::span<const StructureDistance> distances);

}  // namespace osteomill
