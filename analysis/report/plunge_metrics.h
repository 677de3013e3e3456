// Number of times that the burr broke through bone, and how far it plunged (plunge_watch.h).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "analysis/report/plunge_watch.h"

namespace osteomill {

struct PlungeMetrics {
    std::size_t breakthroughs = 0;
    std::optional<double> mean_mm{};  ///< nothing: no breakthrough
    std::optional<double> most_mm{};
};

PlungeMetrics plunge_metrics(std::span<const Breakthrough> breakthroughs);

}  // namespace osteomill
