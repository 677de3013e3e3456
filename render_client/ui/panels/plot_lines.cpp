#include "render_client/ui/panels/plot_lines.h"

#include <algorithm>
#include <cmath>

#include "render_client/ui/panels/round_number.h"

namespace osteomill {

PlotRange plot_range(double least, double most, double smallest_span) {
    PlotRange range{std::min(least, 0.0), std::max(most, 0.0)};
    if (range.high > 0.0) range.high = round_number_from(range.high);
    if (range.low < 0.0) range.low = -round_number_from(-range.low);
    if (range.high - range.low >= smallest_span) return range;
    if (range.low < 0.0 && range.high > 0.0) {
        const double half = round_number_from(0.5 * smallest_span);
        return {std::min(range.low, -half), std::max(range.high, half)};
    }
    return range.low < 0.0 ? PlotRange{-smallest_span, 0.0} : PlotRange{0.0, smallest_span};
}

std::vector<glm::vec2> plot_points(std::span<const PlotSample> samples, double span_s, const PlotRange& range,
                                   const glm::vec2& size) {
    const auto place = [&](const PlotSample& sample) {
        const double part = (sample.value - range.low) / (range.high - range.low);
        return glm::vec2(size.x * static_cast<float>(1.0 - sample.age_s / span_s),
                         size.y * static_cast<float>(1.0 - std::clamp(part, 0.0, 1.0)));
    };
    std::vector<glm::vec2> points;
    for (std::size_t first = 0; first < samples.size();) {
        if (samples[first].age_s > span_s) {
            ++first;
            continue;
        }
        const float column = std::floor(place(samples[first]).x);
        std::size_t least = first, greatest = first, next = first + 1;
        for (; next < samples.size() && std::floor(place(samples[next]).x) == column; ++next) {
            if (samples[next].value < samples[least].value) least = next;
            if (samples[next].value > samples[greatest].value) greatest = next;
        }
        points.push_back(place(samples[std::min(least, greatest)]));
        if (least != greatest) points.push_back(place(samples[std::max(least, greatest)]));
        first = next;
    }
    return points;
}

}  // namespace osteomill
