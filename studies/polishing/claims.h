// Claims of the paper about its experiment, and whether they hold in ours. Each claim is decided by one
// number.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "studies/polishing/published_figures.h"
#include "studies/polishing/tooth_period.h"

namespace osteomill::study {

struct Claim {
    std::string claim;    ///< the paper's, in a few words
    std::string where;    ///< the run, or runs, that it is asked of
    std::string measure;  ///< what the number is
    double measured = 0.0;
    bool must_reach = true;  ///< holds where measured >= bar; if not, where measured <= bar
    double bar = 0.0;

    bool holds() const { return must_reach ? measured >= bar : measured <= bar; }
};

/// Forces rise with depth: rank correlation of the size of each component's slow part, in windows of 0.4 s,
/// with depth; at least `rising_bar`, which twenty windows reach by chance once in eighty times. Three
/// claims, F_x to F_z, for a record of some windows. Of a fresh slot the published equations themselves say
/// that F_z is greatest where tan kappa_d = K_r / K_a, at 1.4 mm with a 5 mm burr, and pulls the burr in
/// below 2.9 mm.
std::vector<Claim> rising_claims(const std::string& where, const ForceRecord& record);
inline constexpr double rising_bar = 0.5;

/// The components are not proportional: their power off one line (share_off_line()) is at least
/// `off_line_bar`. Two thirds is the most that it can be.
Claim proportion_claim(const std::string& where, const ForceRecord& record);
inline constexpr double off_line_bar = 0.05;

/// Without sample-estimate-hold the contact is nearly unstable, with it it is not: the limit cycle's rms
/// reaches chatter_n, or stays below it.
Claim chatter_claim(const std::string& claim, const FigureRun& figure, bool should_chatter);

/// More edges lower the force: of the smallest number of edges over that of the largest. Three claims: the
/// mean force, the force of one tooth, the peak within the tooth period; each must fall by a twentieth.
std::vector<Claim> edges_claims(const std::vector<ToothPeriodForce>& by_edges);
/// A faster spindle lowers the mean force, by the same measure.
Claim speed_claim(const std::string& where, double rpm, double force_n, double faster_rpm,
                  double faster_force_n);
inline constexpr double lowered_bar = 0.95;

Table table_of(const std::vector<Claim>& claims);
/// For people, a line a claim.
std::string text_of(const std::vector<Claim>& claims);

}  // namespace osteomill::study
