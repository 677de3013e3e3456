#include "analysis/report/cutting_metrics.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "common/statistics/percentile.h"

namespace osteomill {

std::string tissue_name(const SessionInfo& session, std::uint8_t label) {
    for (const Tissue& tissue : session.tissues)
        if (tissue.label == label) return tissue.name;
    if (label != 0) return "tissue " + std::to_string(label);
    return std::ranges::find(session.tissues, "bone", &Tissue::name) == session.tissues.end() ? "bone"
                                                                                              : "other bone";
}

RemovalMetrics removal_metrics(const SessionTrace& trace, std::span<const Stroke> strokes) {
    std::array<std::int64_t, 256> left_out{};
    std::int64_t removed = 0;
    std::int64_t undone = 0;
    for (const TraceSample& sample : trace.samples)
        for (const TissueLevels& levels : sample.levels) {
            left_out[levels.tissue] += levels.milled - levels.restored;
            removed += levels.milled - levels.restored;
            undone += levels.restored;
        }
    RemovalMetrics metrics{.removed_mm3 = trace.mm3(removed), .undone_mm3 = trace.mm3(undone)};
    std::set<std::size_t> undos;
    for (const Stroke& stroke : strokes)
        for (const Stroke::Slice& slice : stroke.slices)
            if (slice.undone_by) undos.insert(*slice.undone_by);
    metrics.undos = undos.size();
    std::array<bool, 256> is_named{};
    for (const Tissue& tissue : trace.session.tissues) {
        metrics.by_tissue.push_back({tissue.name, trace.mm3(left_out[tissue.label])});
        is_named[tissue.label] = true;
    }
    for (std::size_t label = 0; label < left_out.size(); ++label)
        if (!is_named[label] && left_out[label] != 0)
            metrics.by_tissue.push_back(
                {tissue_name(trace.session, static_cast<std::uint8_t>(label)), trace.mm3(left_out[label])});
    std::map<std::size_t, std::int64_t> by_burr;
    for (const Stroke& stroke : strokes)
        for (const Stroke::Slice& slice : stroke.slices)
            for (const auto& [burr, levels] : slice.levels_by_burr)
                by_burr[burr] += slice.is_undone() ? 0 : levels;
    for (const auto& [burr, levels] : by_burr)
        metrics.by_burr.push_back({trace.session.burrs[burr].name, trace.mm3(levels)});
    return metrics;
}

namespace {

class ForceSum {
  public:
    void add(double force_n, double dt_s) {
        forces_n_.push_back(force_n);
        time_s_ += dt_s;
        impulse_n_s_ += force_n * dt_s;
    }
    ForceOf of(std::string name) const {
        if (forces_n_.empty()) return {.name = std::move(name)};
        return {.name = std::move(name),
                .time_s = time_s_,
                .mean_n = time_s_ > 0.0 ? impulse_n_s_ / time_s_ : forces_n_.front(),
                .p95_n = percentile(forces_n_, 0.95),
                .impulse_n_s = impulse_n_s_};
    }

  private:
    std::vector<double> forces_n_;
    double time_s_ = 0.0;
    double impulse_n_s_ = 0.0;
};

}  // namespace

ForceMetrics force_metrics(const SessionTrace& trace) {
    ForceMetrics metrics;
    ForceSum cutting;
    std::map<std::uint8_t, ForceSum> by_tissue;
    std::map<std::size_t, ForceSum> by_burr;
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        const TraceSample& now = trace.samples[i];
        metrics.peak_n = std::max(metrics.peak_n, now.force_n);
        if (!now.cuts()) continue;
        const auto most = std::ranges::max_element(now.levels, {}, &TissueLevels::milled);
        for (const TraceMoment& moment : now.moments) {
            cutting.add(moment.force_n, moment.dt_s);
            by_tissue[most->tissue].add(moment.force_n, moment.dt_s);
            by_burr[now.burr].add(moment.force_n, moment.dt_s);
        }
    }
    metrics.peak_n = std::max(metrics.peak_n, trace.peak_force_n.value_or(0.0));
    metrics.cutting = cutting.of("all");
    for (const auto& [label, sum] : by_tissue)
        metrics.by_tissue.push_back(sum.of(tissue_name(trace.session, label)));
    for (const auto& [burr, sum] : by_burr) metrics.by_burr.push_back(sum.of(trace.session.burrs[burr].name));
    return metrics;
}

}  // namespace osteomill
