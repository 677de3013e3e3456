#include "common/scene/burr.h"

#include <algorithm>
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

void require_valid(const ShankProfile& shank, double burr_radius_mm) {
    if (shank.empty()) return;
    constexpr double least_ascent_mm = 0.01;
    if (shank.size() < 2 || shank.size() > 8)
        throw std::invalid_argument("a shank takes 2 to 8 points, not " + std::to_string(shank.size()));
    for (std::size_t i = 0; i < shank.size(); ++i) {
        const std::string point = "shank point " + std::to_string(i);
        if (!(shank[i].radius_mm >= 0.05 && shank[i].radius_mm <= 30.0))
            throw std::invalid_argument(point + " has a radius outside 0.05 to 30 mm");
        if (!(shank[i].height_mm >= 0.5 * burr_radius_mm && shank[i].height_mm <= 200.0))
            throw std::invalid_argument(point + " has a height outside half the burr's radius to 200 mm");
        if (i > 0 && !(shank[i].height_mm - shank[i - 1].height_mm >= least_ascent_mm))
            throw std::invalid_argument(point + " does not lie 0.01 mm or more above the one before");
    }
    if (shank.back().height_mm <= burr_radius_mm)
        throw std::invalid_argument("the shank ends within the burr");
}

bool has_shank(const std::vector<Burr>& burrs) {
    return std::any_of(burrs.begin(), burrs.end(), [](const Burr& burr) { return !burr.shank.empty(); });
}

std::vector<Burr> default_burr_set(double spindle_rev_per_s) {
    const auto burr = [&](const char* name, double diameter_mm) {
        return Burr{.name = name, .diameter_mm = diameter_mm, .spindle_rev_per_s = spindle_rev_per_s};
    };
    return {burr("1 mm", 1.0), burr("1.5 mm", 1.5), burr("2 mm", 2.0),
            burr("3 mm", 3.0), burr("4 mm", 4.0),   burr("5 mm", 5.0)};
}

}  // namespace osteomill
