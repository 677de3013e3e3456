// Percentiles of durations, counted as they come: buckets 3 % wide from 10 ns to 100 s, no allocation after
// construction. Real-time safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace osteomill {

class Histogram {
  public:
    /// Durations outside the buckets' range count in the first or last; negative ones and NaN as zero.
    void add(double seconds) noexcept;

    std::uint64_t count() const { return count_; }
    double max_s() const { return max_s_; }
    /// The duration that a share (0 to 1) of those added do not exceed: the upper edge of the bucket where
    /// that is reached, never above the maximum. 0 if nothing was added.
    double quantile_s(double share) const;

    struct Bucket {
        double up_to_s = 0.0;  ///< upper edge; the last bin's is the maximum
        std::uint64_t count = 0;
    };
    /// Those that are not empty, ascending.
    std::vector<Bucket> filled() const;

    static constexpr double smallest_s = 1e-8;
    static constexpr int buckets_per_octave = 24;
    static constexpr int octaves = 34;

  private:
    double upper_edge_s(std::size_t bucket) const;

    std::array<std::uint64_t, buckets_per_octave * octaves> buckets_{};
    std::uint64_t count_ = 0;
    double max_s_ = 0.0;
};

}  // namespace osteomill
