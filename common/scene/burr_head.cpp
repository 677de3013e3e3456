#include "common/scene/burr_head.h"

#include <stdexcept>
#include <string>

namespace osteomill {

namespace {

constexpr double longest_head_mm = 30.0;
constexpr double narrowest_end = 0.3;

}  // namespace

BurrHead usual_head(HeadShape shape, double diameter_mm, double length_mm) {
    const auto head = [&](double tip, double neck) {
        return BurrHead{shape, length_mm, tip * diameter_mm, neck * diameter_mm};
    };
    switch (shape) {
        case HeadShape::ball:
            return {};
        case HeadShape::cylinder:
            return head(1.0, 1.0);
        case HeadShape::cone:
            return head(0.5, 1.0);
        case HeadShape::barrel:
            return head(0.7, 0.7);
        case HeadShape::pear:
            return head(0.0, 0.6);
    }
    return {};
}

void require_valid(const BurrHead& head, double diameter_mm) {
    const bool is_pear = head.shape == HeadShape::pear;
    if (head.shape == HeadShape::ball) {
        if (head != BurrHead{}) throw std::invalid_argument("a ball takes a diameter and nothing else");
        return;
    }
    const double shortest_mm = is_pear ? diameter_mm : 0.5 * diameter_mm;
    if (!(head.length_mm >= shortest_mm && head.length_mm <= longest_head_mm))
        throw std::invalid_argument(std::string("the head's length must lie within ") +
                                    (is_pear ? "its" : "half its") + " diameter to 30 mm");
    const auto is_end = [&](double end_mm) {
        return end_mm >= narrowest_end * diameter_mm && end_mm <= diameter_mm;
    };
    if (is_pear ? head.tip_diameter_mm != 0.0 : !is_end(head.tip_diameter_mm))
        throw std::invalid_argument(is_pear ? "a pear's tip is a half ball: it takes no tip diameter"
                                            : "the tip must be 0.3 to 1 times as wide as the burr");
    if (!is_end(head.neck_diameter_mm))
        throw std::invalid_argument("the neck's end must be 0.3 to 1 times as wide as the burr");
    const bool tip_is_widest = head.tip_diameter_mm == diameter_mm;
    const bool neck_is_widest = head.neck_diameter_mm == diameter_mm;
    if (head.shape == HeadShape::cylinder && !(tip_is_widest && neck_is_widest))
        throw std::invalid_argument("both ends of a cylinder are as wide as the burr");
    if (head.shape == HeadShape::cone && !(tip_is_widest || neck_is_widest))
        throw std::invalid_argument("one end of a cone must be as wide as the burr");
}

}  // namespace osteomill
