#include "studies/realtime/latencies.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace osteomill::study {

void Latencies::add(double up_to_us, std::uint64_t count) {
    if (count == 0) return;
    by_edge_us_[up_to_us] += count;
    count_ += count;
}

void Latencies::add(const Latencies& others) {
    for (const auto& [up_to_us, count] : others.by_edge_us_) add(up_to_us, count);
}

double Latencies::quantile_us(double share) const {
    const double wanted = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(count_));
    std::uint64_t seen = 0;
    for (const auto& [up_to_us, count] : by_edge_us_) {
        seen += count;
        if (static_cast<double>(seen) >= wanted) return up_to_us;
    }
    return max_us();
}

std::uint64_t Latencies::over(double limit_us) const {
    std::uint64_t over = 0;
    for (auto it = by_edge_us_.upper_bound(limit_us); it != by_edge_us_.end(); ++it) over += it->second;
    return over;
}

Latencies latencies_of_server(const nlohmann::json& histogram) {
    Latencies latencies;
    for (const auto& bucket : histogram)
        latencies.add(bucket.at(0).get<double>(), bucket.at(1).get<std::uint64_t>());
    return latencies;
}

Latencies latencies_of_cyclictest(const nlohmann::json& report) {
    const auto& thread = report.at("thread").at("0");
    Latencies latencies;
    for (const auto& [us, count] : thread.at("histogram").items())
        latencies.add(std::stod(us) + 1.0, count.get<std::uint64_t>());
    const auto cycles = thread.at("cycles").get<std::uint64_t>();
    if (cycles > latencies.count())
        latencies.add(thread.at("max").get<double>() + 1.0, cycles - latencies.count());
    return latencies;
}

void add_bins(Table& table, const Latencies& latencies, const std::string& load, const std::string& what) {
    if (latencies.count() == 0) return;
    constexpr double bins_per_octave = 6.0;
    const auto bin_of = [&](double us) {
        return static_cast<int>(std::ceil(bins_per_octave * std::log2(std::max(us, 1e-3)) - 1e-9));
    };
    const int first = bin_of(latencies.by_edge_us().begin()->first);
    std::vector<std::uint64_t> bins(static_cast<std::size_t>(bin_of(latencies.max_us()) - first + 1), 0);
    for (const auto& [up_to_us, count] : latencies.by_edge_us())
        bins[static_cast<std::size_t>(bin_of(up_to_us) - first)] += count;

    const auto all = static_cast<double>(latencies.count());
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        seen += bins[i];
        const double octaves = (first + static_cast<double>(i)) / bins_per_octave;
        table.add({load, what, std::exp2(octaves - 1.0 / bins_per_octave), std::exp2(octaves),
                   static_cast<double>(bins[i]) / all, static_cast<double>(latencies.count() - seen) / all});
    }
}

}  // namespace osteomill::study
