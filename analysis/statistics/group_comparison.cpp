#include "analysis/statistics/group_comparison.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>
#include <vector>

namespace osteomill {

namespace {

/// Gamma(m/2) / (sqrt(m/2) Gamma((m-1)/2)), about 1 - 3 / (4 m - 1).
double small_sample_correction(double degrees) {
    return 1.0 / (std::sqrt(0.5 * degrees) * boost::math::tgamma_delta_ratio(0.5 * (degrees - 1.0), 0.5));
}

/// Twice the rank of each value, first group first: whole numbers even where values tie.
std::vector<std::size_t> doubled_ranks(std::span<const double> first, std::span<const double> second) {
    std::vector<double> all(first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    std::vector<double> sorted = all;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::size_t> ranks;
    for (const double value : all) {
        const auto [first_equal, behind] = std::equal_range(sorted.begin(), sorted.end(), value);
        const auto below = static_cast<std::size_t>(first_equal - sorted.begin());
        ranks.push_back(2 * below + static_cast<std::size_t>(behind - first_equal) + 1);
    }
    return ranks;
}

/// In how many ways `count` of the ranks have each sum.
std::vector<double> ways_of_sums(const std::vector<std::size_t>& ranks, std::size_t count) {
    const std::size_t most = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
    std::vector<std::vector<double>> ways(count + 1, std::vector<double>(most + 1, 0.0));
    ways[0][0] = 1.0;
    for (const std::size_t rank : ranks)
        for (std::size_t taken = count; taken-- > 0;)
            for (std::size_t sum = 0; sum + rank <= most; ++sum)
                ways[taken + 1][sum + rank] += ways[taken][sum];
    return std::move(ways[count]);
}

}  // namespace

std::optional<WelchComparison> compare_means(std::span<const double> first, std::span<const double> second) {
    if (first.size() < 2 || second.size() < 2) return std::nullopt;
    const auto n1 = static_cast<double>(first.size());
    const auto n2 = static_cast<double>(second.size());
    const double v1 = sample_variance(first);
    const double v2 = sample_variance(second);
    const double squared_error = v1 / n1 + v2 / n2;
    if (!(squared_error > 0.0)) return std::nullopt;
    WelchComparison result{.difference = mean_of(first) - mean_of(second)};
    result.t = result.difference / std::sqrt(squared_error);
    result.degrees =
        squared_error * squared_error / (v1 * v1 / (n1 * n1 * (n1 - 1.0)) + v2 * v2 / (n2 * n2 * (n2 - 1.0)));
    result.p = two_sided_p(result.t, result.degrees);
    const double half = interval_errors(result.degrees) * std::sqrt(squared_error);
    result.interval = {result.difference - half, result.difference + half};
    const double pooled_degrees = n1 + n2 - 2.0;
    const double pooled = std::sqrt(((n1 - 1.0) * v1 + (n2 - 1.0) * v2) / pooled_degrees);
    result.hedges_g = small_sample_correction(pooled_degrees) * result.difference / pooled;
    return result;
}

std::optional<RankComparison> compare_ranks(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty() || first.size() + second.size() > most_ranked) return std::nullopt;
    const std::vector<std::size_t> ranks = doubled_ranks(first, second);
    const auto own = static_cast<std::ptrdiff_t>(first.size());
    const std::size_t sum = std::accumulate(ranks.begin(), ranks.begin() + own, std::size_t{0});
    const std::vector<double> ways = ways_of_sums(ranks, first.size());
    const auto at = ways.begin() + static_cast<std::ptrdiff_t>(sum);
    const double at_most = std::accumulate(ways.begin(), at + 1, 0.0);
    const double at_least = std::accumulate(at, ways.end(), 0.0);
    const double all = at_most + at_least - *at;
    const auto n1 = static_cast<double>(first.size());
    const auto n2 = static_cast<double>(second.size());
    const double u = 0.5 * static_cast<double>(sum) - 0.5 * n1 * (n1 + 1.0);
    return RankComparison{.u = u,
                          .p = std::min(1.0, 2.0 * std::min(at_most, at_least) / all),
                          .cliffs_delta = 2.0 * u / (n1 * n2) - 1.0};
}

}  // namespace osteomill
