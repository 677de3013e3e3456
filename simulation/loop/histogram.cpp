#include "simulation/loop/histogram.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

void Histogram::add(double seconds) noexcept {
    const double duration_s = seconds > 0.0 ? seconds : 0.0;
    const double position =
        duration_s > smallest_s ? buckets_per_octave * std::log2(duration_s / smallest_s) : 0.0;
    const auto last = static_cast<double>(buckets_.size() - 1);
    ++buckets_[static_cast<std::size_t>(std::min(position, last))];
    ++count_;
    max_s_ = std::max(max_s_, duration_s);
}

double Histogram::upper_edge_s(std::size_t bucket) const {
    if (bucket + 1 == buckets_.size()) return max_s_;
    return std::min(smallest_s * std::exp2(static_cast<double>(bucket + 1) / buckets_per_octave), max_s_);
}

std::vector<Histogram::Bucket> Histogram::filled() const {
    std::vector<Bucket> filled;
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket)
        if (buckets_[bucket] > 0) filled.push_back({upper_edge_s(bucket), buckets_[bucket]});
    return filled;
}

double Histogram::quantile_s(double share) const {
    const double wanted = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(count_));
    std::uint64_t seen = 0;
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
        seen += buckets_[bucket];
        if (seen > 0 && static_cast<double>(seen) >= wanted) {
            return upper_edge_s(bucket);
        }
    }
    return max_s_;
}

}  // namespace osteomill
