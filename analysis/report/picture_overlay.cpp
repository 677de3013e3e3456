#include "analysis/report/picture_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

constexpr double size = 300.0;

std::string letters_at(double x, double y, const glm::dvec3& direction) {
    return fmt::format("<text x='{:.0f}' y='{:.0f}'>{}</text>", x, y, direction_letters(direction));
}

std::string scale_bar(double half_width_mm) {
    double length_mm = 0.1;
    for (const double candidate : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
        if (candidate <= 0.5 * half_width_mm) length_mm = candidate;
    const double length = 0.5 * size * length_mm / half_width_mm;
    return fmt::format(
        "<path d='M14 {0:.0f}v6h{1:.2f}v-6' fill='none' stroke='#fff' stroke-width='4'/>"
        "<path d='M14 {0:.0f}v6h{1:.2f}v-6' fill='none' stroke='#000' stroke-width='1.6'/>"
        "<text x='{2:.1f}' y='{3:.0f}'>{4:g} mm</text>",
        size - 16.0, length, 14.0 + 0.5 * length, size - 18.0, length_mm);
}

}  // namespace

std::string direction_letters(const glm::dvec3& direction) {
    struct Part {
        double size;
        char letter;
    };
    std::array<Part, 3> parts{{{std::abs(direction.x), direction.x > 0.0 ? 'L' : 'R'},
                               {std::abs(direction.y), direction.y > 0.0 ? 'P' : 'A'},
                               {std::abs(direction.z), direction.z > 0.0 ? 'S' : 'I'}}};
    std::ranges::stable_sort(parts, std::ranges::greater(), &Part::size);
    std::string letters;
    for (const Part& part : parts)
        if (part.size >= 0.35) letters += part.letter;
    return letters;
}

std::string picture_overlay(const BoneView& view, const std::optional<SeenBurr>& burr) {
    const glm::dvec3 right = glm::cross(view.direction, view.up);
    const double per_mm = 0.5 * size / view.half_width_mm;
    std::string svg = fmt::format(
        "<svg viewBox='0 0 {0:g} {0:g}' font-family='sans-serif' font-size='13' font-weight='bold' "
        "text-anchor='middle' fill='#000' stroke='#fff' stroke-width='3' paint-order='stroke'>",
        size);
    if (burr) {
        const auto place = [&](const glm::dvec3& at_mm) {
            const glm::dvec3 offset = at_mm - view.centre_mm;
            return fmt::format("{:.2f} {:.2f}", 0.5 * size + per_mm * glm::dot(offset, right),
                               0.5 * size - per_mm * glm::dot(offset, view.up));
        };
        const double radius_mm = 0.5 * burr->diameter_mm;
        const std::string neck = place(burr->centre_mm + radius_mm * burr->spindle_axis);
        const std::string shank =
            place(burr->centre_mm + (radius_mm + 0.8 * view.half_width_mm) * burr->spindle_axis);
        for (const char* const style : {"stroke='#fff' stroke-width='4'", "stroke='#b00' stroke-width='1.8'"})
            svg += fmt::format(
                "<g fill='none' {0}><path d='M{1}L{2}'/><circle transform='translate({3})' r='{4:.2f}'/></g>",
                style, neck, shank, place(burr->centre_mm), per_mm * radius_mm);
    }
    svg += letters_at(10.0, 0.5 * size + 5.0, -right) + letters_at(size - 10.0, 0.5 * size + 5.0, right) +
           letters_at(0.5 * size, 15.0, view.up) + letters_at(0.5 * size, size - 5.0, -view.up);
    return svg + scale_bar(view.half_width_mm) + "</svg>";
}

}  // namespace osteomill
