// The study of sites: named ones and random walks, each with several burrs, hands and devices; tables, bars,
// the worst cases by name, and a chart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/surroundings.h"
#include "analysis/output/table.h"
#include "studies/stability/sites/site_run.h"
#include "studies/stability/sites/site_verdict.h"

namespace osteomill::study {

struct SiteStudyOptions {
    std::filesystem::path out = "study/stability";
    std::vector<std::string> methods{"implicit"};
    bool quick = false;  ///< one burr at one speed, a firm hand, an ideal device
    int walks = 0;
    std::uint64_t seed = 1;
    bool has_edge_forces = false;  ///< burrs whose edges rub with 0.3 N/mm, as the tooth scene's
    std::string only{};            ///< cases whose name holds this; one alone writes trace.csv, too
};

struct SiteCase {
    Site site;
    SiteHand hand;
};

/// "plate of 1 mm tilted by 15, 5 mm burr at 10000 rpm, implicit, firm, ideal device, 0 ticks late".
std::string name_of(const SiteCase& c);

/// In a fixed order, whatever `only` says.
std::vector<SiteCase> site_cases(const SiteStudyOptions& options);

struct SiteResult {
    std::string kind;
    std::string name;
    SiteVerdict verdict{};
    SolveCounts solve{};
    std::uint64_t faults = 0;

    bool is_met() const { return worst_share(verdict, kind) <= 1.0 && faults == 0; }
};

/// A line a case.
Table site_table_of(const std::vector<SiteResult>& results);
/// What the chart draws: a line for each number of each case, as a share of its bar.
Table site_points_of(const std::vector<SiteResult>& results);
/// By kind how many meet the bars and the worst of each number; the ten worst cases with the command of each.
nlohmann::ordered_json site_summary(const std::vector<SiteResult>& results, const SiteStudyOptions& options);

/// Runs the cases and writes sites.csv, sites.json, site_points.csv and sites.svg into options.out. Throws
/// std::runtime_error in one line where nothing is selected or a file cannot be written.
void run_site_study(const SiteStudyOptions& options, const StudySurroundings& surroundings);

}  // namespace osteomill::study
