// The shape of a burr's cutting head: the ball, or a body of revolution with flat or tapered sides.
#pragma once

#include <array>
#include <string_view>

namespace osteomill {

/// `ball`: a sphere. `cylinder`: straight sides (a fissure burr). `cone`: tapered sides. `barrel`: widest in
/// the middle. `pear`: a half ball at the tip that tapers to the neck.
enum class HeadShape { ball, cylinder, cone, barrel, pear };

inline constexpr std::array<std::string_view, 5> head_shape_names{"ball", "cylinder", "cone", "barrel",
                                                                  "pear"};

/// The head's sizes besides the burr's diameter, which is the largest of the head. A ball has none.
struct BurrHead {
    HeadShape shape = HeadShape::ball;
    double length_mm = 0.0;         ///< from the tip to the neck's end, along the spindle
    double tip_diameter_mm = 0.0;   ///< at the tip's face; of a pear nothing
    double neck_diameter_mm = 0.0;  ///< at the face towards the shank

    bool operator==(const BurrHead&) const = default;
};

/// A head of the usual proportions: a cone half as wide at its tip, a barrel 0.7 as wide at both ends, a pear
/// 0.6 as wide at its neck.
BurrHead usual_head(HeadShape shape, double diameter_mm, double length_mm);

/// Throws std::invalid_argument unless the head is a ball with nothing else set, or its length lies within
/// half its diameter to 30 mm (of a pear: from one diameter on), and its ends are between 0.3 times the
/// diameter and the diameter; a cylinder's are the diameter, and one end of a cone is.
void require_valid(const BurrHead& head, double diameter_mm);

}  // namespace osteomill
