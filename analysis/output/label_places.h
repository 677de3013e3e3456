// Labels in a column beside a chart: as near to their points' heights as they go without touching.
#pragma once

#include <vector>

namespace osteomill::study {

/// Heights of labels whose points are at `heights`, in the same order: at least `gap` apart, in the order of
/// the points, moved as little as that allows (least squares, by pooling neighbours that are too close).
std::vector<double> label_places(const std::vector<double>& heights, double gap);

}  // namespace osteomill::study
