// Latencies gathered from several runs, as counts by upper edge.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/output/table.h"

namespace osteomill::study {

class Latencies {
  public:
    /// `count` of them lasted `up_to_us`, or less and longer than the next smaller edge.
    void add(double up_to_us, std::uint64_t count);
    void add(const Latencies& others);

    std::uint64_t count() const { return count_; }
    /// 0 where there are none.
    double max_us() const { return by_edge_us_.empty() ? 0.0 : by_edge_us_.rbegin()->first; }
    /// The edge that a share (0 to 1) of them do not exceed; 0 where there are none.
    double quantile_us(double share) const;
    /// Those of edges above `limit_us`.
    std::uint64_t over(double limit_us) const;

    const std::map<double, std::uint64_t>& by_edge_us() const { return by_edge_us_; }

    NLOHMANN_DEFINE_TYPE_INTRUSIVE(Latencies, by_edge_us_, count_)

  private:
    std::map<double, std::uint64_t> by_edge_us_;
    std::uint64_t count_ = 0;
};

/// Of one of those that haptic_server --json writes beside its file. Throws nlohmann::json::exception for
/// what is none.
Latencies latencies_of_server(const nlohmann::json& histogram);

/// Of cyclictest --json with one thread: whole microseconds, rounded down, so 12 lies below 13. Those beyond
/// its histogram go to its maximum. Throws as above.
Latencies latencies_of_cyclictest(const nlohmann::json& report);

/// Rows of a table of load, what, from_us, up_to_us, share and share_above, in bins of a sixth of an octave,
/// all that are between the first and the last that is not empty.
void add_bins(Table& table, const Latencies& latencies, const std::string& load, const std::string& what);

}  // namespace osteomill::study
