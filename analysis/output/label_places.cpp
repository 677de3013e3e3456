#include "analysis/output/label_places.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace osteomill::study {

namespace {

/// Labels that stand gap by gap above one another.
struct Pool {
    double first;  ///< where its lowest label stands
    std::size_t labels;
};

}  // namespace

std::vector<double> label_places(const std::vector<double>& heights, double gap) {
    std::vector<std::size_t> upward(heights.size());
    std::iota(upward.begin(), upward.end(), std::size_t{0});
    std::stable_sort(upward.begin(), upward.end(),
                     [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
    std::vector<Pool> pools;
    for (const std::size_t i : upward) {
        pools.push_back({heights[i], 1});
        while (pools.size() > 1) {
            const Pool above = pools.back();
            Pool& below = pools[pools.size() - 2];
            const double below_labels = static_cast<double>(below.labels);
            const double above_labels = static_cast<double>(above.labels);
            if (above.first >= below.first + gap * below_labels) break;
            below.first = (below_labels * below.first + above_labels * (above.first - gap * below_labels)) /
                          (below_labels + above_labels);
            below.labels += above.labels;
            pools.pop_back();
        }
    }
    std::vector<double> places(heights.size());
    auto next = upward.begin();
    for (const Pool& pool : pools)
        for (std::size_t label = 0; label < pool.labels; ++label)
            places[*next++] = pool.first + gap * static_cast<double>(label);
    return places;
}

}  // namespace osteomill::study
