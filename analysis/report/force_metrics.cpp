#include "analysis/report/force_metrics.h"

#include <algorithm>
#include <map>

#include "analysis/report/removal_metrics.h"
#include "common/statistics/percentile.h"

namespace osteomill {

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
