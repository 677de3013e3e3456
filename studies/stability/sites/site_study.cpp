#include "studies/stability/sites/site_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "analysis/output/study_run.h"
#include "studies/stability/sites/named_sites.h"
#include "studies/stability/sites/random_walk.h"

namespace osteomill {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SolveCounts, max_residual_n, fallbacks, relaxed, damped)

namespace study {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SiteVerdict, energy_over_rigid_mj, energy_mj, stuck_ms, error_percent,
                                   error_while_driven_percent, largest_jump_n, peak_n, noise_n)

namespace {

using nlohmann::ordered_json;

constexpr std::size_t named_worst = 10;

/// What is kept of a run.
struct SiteOutcome {
    SiteVerdict verdict{};
    SolveCounts solve{};
    std::uint64_t faults = 0;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SiteOutcome, verdict, solve, faults)

std::vector<SiteHand> hands(const SiteStudyOptions& options) {
    std::vector<SiteHand> found;
    for (const std::string& method : options.methods) {
        found.push_back({.method = method});
        if (options.quick) continue;
        found.push_back({.method = method, .delay_ticks = 1});
        found.push_back({.method = method, .is_ideal_device = false});
        found.push_back({.method = method, .grip = Grip::light});
    }
    return found;
}

std::vector<Burr> burrs(bool quick) {
    std::vector<Burr> found;
    for (const double diameter_mm : quick ? std::vector{5.0} : std::vector{1.0, 2.0, 3.0, 5.0})
        for (const double rpm :
             quick ? std::vector{10'000.0} : std::vector{5'000.0, 10'000.0, 20'000.0, 80'000.0})
            found.push_back({.diameter_mm = diameter_mm, .spindle_rev_per_s = rpm / 60.0});
    return found;
}

Table trace_of(const SiteRun& run) {
    Table table({"t_s", "hand_x_mm", "hand_y_mm", "hand_z_mm", "burr_x_mm", "burr_y_mm", "burr_z_mm",
                 "force_x_n", "force_y_n", "force_z_n", "model_x_n", "model_y_n", "model_z_n", "rigid_x_n",
                 "rigid_y_n", "rigid_z_n", "spindle"});
    double time_s = 0.0;
    for (const SiteTick& tick : run.ticks) {
        std::vector<nlohmann::ordered_json> row{time_s};
        for (const glm::dvec3& v : {tick.hand_mm, tick.burr_mm, tick.force_n, tick.model_n, tick.rigid_n})
            row.insert(row.end(), {v.x, v.y, v.z});
        row.push_back(tick.spindle_on);
        table.add(std::move(row));
        time_s += 0.001;
    }
    return table;
}

/// In the order of the cases.
std::vector<std::string> kinds_of(const std::vector<SiteResult>& results) {
    std::vector<std::string> kinds;
    for (const SiteResult& result : results)
        if (std::find(kinds.begin(), kinds.end(), result.kind) == kinds.end()) kinds.push_back(result.kind);
    return kinds;
}

std::string command_of(const SiteResult& result, const SiteStudyOptions& options) {
    return fmt::format(
        "osteomill_study stability --sites{}{}{} --methods {} --only '{}'", options.quick ? " --quick" : "",
        options.has_edge_forces ? " --edge-forces" : "",
        options.walks > 0 ? fmt::format(" --walks {} --seed {}", options.walks, options.seed) : "",
        fmt::join(options.methods, ","), result.name);
}

ordered_json json_of(const SiteVerdict& verdict) {
    ordered_json json;
    for (const SiteBar& bar : site_bars) json[std::string(bar.what)] = verdict.*bar.value;
    return json;
}

}  // namespace

std::string name_of(const SiteCase& c) {
    return fmt::format("{}, {:.3g} mm burr at {:.0f} rpm, {}, {}, {} device, {} ticks late", c.site.name,
                       c.site.burr.diameter_mm, 60.0 * c.site.burr.spindle_rev_per_s, c.hand.method,
                       c.hand.grip == Grip::firm ? "firm" : "light",
                       c.hand.is_ideal_device ? "ideal" : "real", c.hand.delay_ticks);
}

std::vector<SiteCase> site_cases(const SiteStudyOptions& options) {
    std::vector<SiteCase> cases;
    for (const SiteHand& hand : hands(options)) {
        for (const Burr& burr : burrs(options.quick))
            for (Site& site : named_sites(burr)) cases.push_back({std::move(site), hand});
        for (Site& site : tilts_in_holes()) cases.push_back({std::move(site), hand});
        for (int number = 1; number <= options.walks; ++number)
            cases.push_back({random_walk(options.seed, number), hand});
    }
    if (options.has_edge_forces)
        for (SiteCase& c : cases) c.site.burr.edge_coefficients_n_per_mm = {0.3, 0.3, 0.0};
    std::erase_if(cases,
                  [&](const SiteCase& c) { return name_of(c).find(options.only) == std::string::npos; });
    return cases;
}

Table site_table_of(const std::vector<SiteResult>& results) {
    Table table({"kind", "name", "energy_over_rigid_mj", "energy_mj", "stuck_ms", "error_percent",
                 "error_while_driven_percent", "largest_jump_n", "peak_n", "noise_n", "max_residual_n",
                 "fallbacks", "relaxed", "damped", "faults", "is_met"});
    for (const SiteResult& r : results)
        table.add({r.kind, r.name, r.verdict.energy_over_rigid_mj, r.verdict.energy_mj, r.verdict.stuck_ms,
                   r.verdict.error_percent, r.verdict.error_while_driven_percent, r.verdict.largest_jump_n,
                   r.verdict.peak_n, r.verdict.noise_n, r.solve.max_residual_n, r.solve.fallbacks,
                   r.solve.relaxed, r.solve.damped, r.faults, r.is_met()});
    return table;
}

Table site_points_of(const std::vector<SiteResult>& results) {
    const std::vector<std::string> kinds = kinds_of(results);
    Table table({"kind", "name", "bar", "share"});
    for (const SiteResult& r : results) {
        const auto kind = std::find(kinds.begin(), kinds.end(), r.kind) - kinds.begin();
        for (std::size_t bar = 0; bar < site_bars.size(); ++bar)
            table.add({kind, r.kind, bar, share_of_bar(r.verdict, site_bars[bar], r.kind)});
    }
    return table;
}

ordered_json site_summary(const std::vector<SiteResult>& results, const SiteStudyOptions& options) {
    ordered_json kinds = ordered_json::object();
    for (const std::string& kind : kinds_of(results)) {
        SiteVerdict worst;
        int cases = 0;
        int met = 0;
        std::uint64_t faults = 0;
        for (const SiteResult& r : results) {
            if (r.kind != kind) continue;
            ++cases;
            met += r.is_met() ? 1 : 0;
            faults += r.faults;
            worst.energy_mj = std::max(worst.energy_mj, r.verdict.energy_mj);
            for (const SiteBar& bar : site_bars)
                worst.*bar.value = std::max(worst.*bar.value, r.verdict.*bar.value);
        }
        kinds[kind] = {{"cases", cases},
                       {"met", met},
                       {"faults", faults},
                       {"most_energy_mj", worst.energy_mj},
                       {"worst", json_of(worst)}};
    }
    std::vector<const SiteResult*> by_share;
    for (const SiteResult& r : results) by_share.push_back(&r);
    std::stable_sort(by_share.begin(), by_share.end(), [](const SiteResult* a, const SiteResult* b) {
        return worst_share(a->verdict, a->kind) > worst_share(b->verdict, b->kind);
    });
    ordered_json worst = ordered_json::array();
    for (std::size_t i = 0; i < std::min(named_worst, by_share.size()); ++i)
        worst.push_back({{"name", by_share[i]->name},
                         {"kind", by_share[i]->kind},
                         {"share_of_bar", worst_share(by_share[i]->verdict, by_share[i]->kind)},
                         {"verdict", json_of(by_share[i]->verdict)},
                         {"faults", by_share[i]->faults},
                         {"command", command_of(*by_share[i], options)}});
    return {{"kinds", kinds}, {"worst", worst}};
}

void run_site_study(const SiteStudyOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    const std::vector<SiteCase> cases = site_cases(options);
    if (cases.empty()) throw std::runtime_error("no site is called '" + options.only + "'");
    StudyRun run(options.out, surroundings);
    const bool has_trace = cases.size() == 1;
    const auto planned = run.plan(cases, name_of, [&](const SiteCase& c) {
        const SiteRun at_site = run_site(c.site, c.hand);
        if (has_trace) run.write(trace_of(at_site), "trace");
        return SiteOutcome{verdict_on(at_site), at_site.solve, at_site.faults};
    });
    if (!run.perform()) return;
    std::vector<SiteResult> results;
    for (const SiteOutcome& outcome : planned.outcomes()) {
        const SiteCase& c = cases[results.size()];
        results.push_back({c.site.kind, name_of(c), outcome.verdict, outcome.solve, outcome.faults});
    }
    run.write(site_table_of(results), "sites");
    run.write(site_points_of(results), "site_points");
    const ordered_json summary = site_summary(results, options);
    run.write(summary, "sites");
    run.draw({"sites"});
    for (const auto& [kind, of_kind] : summary.at("kinds").items())
        run.say("{:22} {:4} of {:4} meet the bars", kind, of_kind.at("met").get<int>(),
                of_kind.at("cases").get<int>());
    run.say("worst: {}", summary.at("worst").front().at("name").get<std::string>());
    run.say("sites.json, tables (CSV) and a chart (SVG) are in {}", options.out.string());
}

}  // namespace study
}  // namespace osteomill
