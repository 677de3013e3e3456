#include "analysis/report/nearness_metrics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace osteomill {

namespace {

constexpr double piece_mm = 0.5;
constexpr double least_slope = 1.0 / std::numbers::sqrt2;  // of 45 degrees

class ForceAndFeedSum {
  public:
    void add(const SessionTrace& trace, std::size_t i) {
        const TraceSample& now = trace.samples[i];
        for (const TraceMoment& moment : now.moments) {
            force_s_ += moment.dt_s;
            force_n_s_ += moment.force_n * moment.dt_s;
        }
        if (i == 0 || trace.leaps(i)) return;
        path_s_ += trace.dt_s(i);
        path_mm_ += glm::length(now.burr_mm - trace.samples[i - 1].burr_mm);
    }
    ForceAndFeed result() const {
        ForceAndFeed all{.time_s = force_s_};
        if (force_s_ > 0.0) all.force_n = force_n_s_ / force_s_;
        if (path_s_ > 0.0) all.feed_mm_per_s = path_mm_ / path_s_;
        return all;
    }

  private:
    double force_s_ = 0.0;
    double force_n_s_ = 0.0;
    double path_s_ = 0.0;
    double path_mm_ = 0.0;
};

/// A piece of a stroke under way.
struct Piece {
    glm::dvec3 from_mm;
    double from_distance_mm;
};

struct Sums {
    std::array<ForceAndFeedSum, near_mm.size()> within{};
    NearStructure directions{};
    std::optional<Piece> piece{};

    void lead(const glm::dvec3& to_mm, double distance_mm) {
        const double length_mm = glm::length(to_mm - piece->from_mm);
        if (length_mm < piece_mm - 1e-6) return;
        const double slope = (piece->from_distance_mm - distance_mm) / length_mm;
        (slope > least_slope    ? directions.toward_mm
         : slope < -least_slope ? directions.away_mm
                                : directions.along_mm) += length_mm;
        piece = Piece{to_mm, distance_mm};
    }
};

/// Nothing: further than `farthest_mm`.
std::optional<double> distance_mm(const TraceSample& sample, std::size_t tissue, double farthest_mm) {
    const auto found = std::ranges::find(sample.distances, tissue, &StructureDistance::tissue);
    if (found == sample.distances.end() || !found->distance_mm || *found->distance_mm > farthest_mm)
        return std::nullopt;
    return found->distance_mm;
}

void add_frame(const SessionTrace& trace, std::size_t i, std::size_t tissue,
               std::map<std::size_t, Sums>& all) {
    const TraceSample& now = trace.samples[i];
    const auto is_at_mm = now.cuts() ? distance_mm(now, tissue, near_mm.back()) : std::nullopt;
    if (!is_at_mm) {
        if (const auto known = all.find(tissue); known != all.end()) known->second.piece.reset();
        return;
    }
    Sums& sums = all[tissue];
    for (std::size_t k = 0; k < near_mm.size(); ++k)
        if (*is_at_mm <= near_mm[k]) sums.within[k].add(trace, i);
    if (i == 0 || trace.leaps(i)) {
        sums.piece.reset();
        return;
    }
    // The frame's path begins at the frame before, which need not have cut.
    if (const auto was_at_mm = distance_mm(trace.samples[i - 1], tissue, near_mm.back());
        was_at_mm && !sums.piece)
        sums.piece = Piece{trace.samples[i - 1].burr_mm, *was_at_mm};
    if (sums.piece) sums.lead(now.burr_mm, *is_at_mm);
}

}  // namespace

std::optional<double> NearStructure::toward_share() const {
    const double all_mm = toward_mm + along_mm + away_mm;
    return all_mm > 0.0 ? std::optional(toward_mm / all_mm) : std::nullopt;
}

NearnessMetrics nearness_metrics(const SessionTrace& trace) {
    ForceAndFeedSum elsewhere;
    std::map<std::size_t, Sums> all;
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        bool is_near = false;
        for (const StructureAccount& account : trace.structures) {
            const std::size_t tissue = account.last.tissue;
            add_frame(trace, i, tissue, all);
            is_near = is_near || distance_mm(trace.samples[i], tissue, near_mm.back());
        }
        if (trace.samples[i].cuts() && !is_near) elsewhere.add(trace, i);
    }
    NearnessMetrics metrics{.elsewhere = elsewhere.result()};
    for (auto& [tissue, sums] : all) {
        NearStructure one = sums.directions;
        one.name = trace.session.tissues[tissue].name;
        for (std::size_t k = 0; k < near_mm.size(); ++k) one.within[k] = sums.within[k].result();
        metrics.structures.push_back(std::move(one));
    }
    return metrics;
}

}  // namespace osteomill
