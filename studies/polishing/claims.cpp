#include "studies/polishing/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace osteomill::study {

namespace {

constexpr double rise_window_s = 0.4;
constexpr std::array components{"F_x", "F_y", "F_z"};

Claim lowered(const std::string& claim, const std::string& where, const std::string& measure, double ratio) {
    return {.claim = claim,
            .where = where,
            .measure = measure,
            .measured = ratio,
            .must_reach = false,
            .bar = lowered_bar};
}

}  // namespace

std::vector<Claim> rising_claims(const std::string& where, const ForceRecord& record) {
    const std::vector<ForceWindow> windows = windows_of(record, rise_window_s);
    std::vector<double> depths;
    for (const ForceWindow& window : windows) depths.push_back(window.depth_mm);
    std::vector<Claim> claims;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> forces;
        for (const ForceWindow& window : windows) forces.push_back(window.slow_rms_n[axis]);
        const auto largest = std::max_element(forces.begin(), forces.end()) - forces.begin();
        claims.push_back(
            {.claim = fmt::format("{} rises with depth", components[static_cast<std::size_t>(axis)]),
             .where = where,
             .measure = fmt::format("rank correlation with depth; largest at {:.1f} mm",
                                    depths.at(static_cast<std::size_t>(largest))),
             .measured = rank_correlation(depths, forces),
             .bar = rising_bar});
    }
    return claims;
}

Claim proportion_claim(const std::string& where, const ForceRecord& record) {
    return {.claim = "components are not proportional to each other",
            .where = where,
            .measure = "share of their power off one line",
            .measured = share_off_line(record),
            .bar = off_line_bar};
}

Claim chatter_claim(const std::string& claim, const FigureRun& figure, bool should_chatter) {
    return {.claim = claim,
            .where = figure.name(),
            .measure = "limit cycle, N rms",
            .measured = figure.limit_cycle_n,
            .must_reach = should_chatter,
            .bar = chatter_n};
}

std::vector<Claim> edges_claims(const std::vector<ToothPeriodForce>& by_edges) {
    const ToothPeriodForce& few = by_edges.front();
    const ToothPeriodForce& many = by_edges.back();
    const std::string where =
        fmt::format("on rails, 10 kHz, {} edges over {}", many.setup.edges, few.setup.edges);
    return {lowered("more edges lower the mean force, equation (2)", where, "mean |F|, ratio",
                    many.mean_n / few.mean_n),
            lowered("more edges lower the force of one tooth", where, "mean |F| of a tooth, ratio",
                    many.one_tooth_n / few.one_tooth_n),
            lowered("more edges lower the peak in the tooth period, equation (1)", where,
                    "99th percentile of |F(t)|, ratio",
                    many.mean_n * many.peak_over_mean / (few.mean_n * few.peak_over_mean))};
}

Claim speed_claim(const std::string& where, double rpm, double force_n, double faster_rpm,
                  double faster_force_n) {
    return lowered("a faster spindle lowers the force",
                   fmt::format("{}, {:.0f} rpm over {:.0f}", where, faster_rpm, rpm), "mean |F|, ratio",
                   faster_force_n / force_n);
}

Table table_of(const std::vector<Claim>& claims) {
    Table table({"claim", "where", "measure", "measured", "must_be", "bar", "holds"});
    for (const Claim& c : claims)
        table.add({c.claim, c.where, c.measure, c.measured, c.must_reach ? "at least" : "at most", c.bar,
                   c.holds()});
    return table;
}

std::string text_of(const std::vector<Claim>& claims) {
    std::string text = fmt::format("{:<64} {:<46} {:>9} {:>8}\n", "claim", "where", "measured", "bar");
    for (const Claim& c : claims)
        text += fmt::format("{:<64} {:<46} {:>9.3f} {:>2} {:<5g} {}  ({})\n", c.claim, c.where, c.measured,
                            c.must_reach ? ">=" : "<=", c.bar, c.holds() ? "holds" : "FAILS", c.measure);
    return text;
}

}  // namespace osteomill::study
