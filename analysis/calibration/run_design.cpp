#include "analysis/calibration/run_design.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace osteomill::study {

namespace {

using Information = Eigen::Matrix<double, coefficient_count, coefficient_count>;

constexpr double tiny = 1e-9;

/// Geometry decides the regressors; feed and speed scale them.
void add_feeds(const RunLattice& lattice, RunSetting setting, std::vector<Candidate>& candidates) {
    setting.feed_mm_per_s = lattice.feeds_mm_per_s.front();
    setting.rpm = lattice.rpm.front();
    const RunRegressors geometry = regressors_of(setting);
    for (const double feed_mm_per_s : lattice.feeds_mm_per_s)
        for (const double rpm : lattice.rpm) {
            RunSetting s = setting;
            s.feed_mm_per_s = feed_mm_per_s;
            s.rpm = rpm;
            candidates.push_back({s, at_other_feed(geometry, setting, feed_mm_per_s, rpm)});
        }
}

/// An upright burr leans nowhere: it is one candidate, not one for each direction.
std::vector<double> directions_of(const RunLattice& lattice, double tilt_deg) {
    return tilt_deg == 0.0 ? std::vector{0.0} : lattice.tilt_directions_deg;
}

/// Columns of like size, so that determinants are neither lost nor infinite.
Coefficients column_scale(const std::vector<Candidate>& candidates) {
    Coefficients squares = Coefficients::Zero();
    for (const Candidate& c : candidates) squares += c.regressors.colwise().squaredNorm().transpose();
    return (squares / static_cast<double>(candidates.size())).cwiseSqrt();
}

double log_determinant(const Information& information) {
    const Eigen::LDLT<Information> factors(information);
    const auto diagonal = factors.vectorD();
    if (!(diagonal.minCoeff() > 0.0)) return -std::numeric_limits<double>::infinity();
    return diagonal.array().log().sum();
}

/// Exchange from one random start, over the information of each candidate.
class Exchange {
  public:
    Exchange(const std::vector<Information>& information, int runs, std::mt19937_64& random)
        : information_(information), is_taken_(information.size(), false), chosen_(information.size()) {
        std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
        std::shuffle(chosen_.begin(), chosen_.end(), random);
        chosen_.resize(static_cast<std::size_t>(runs));
        // A random start may tell nothing of a coefficient: a trace of everything lets it grow out of that.
        sum_ = tiny * Information::Identity();
        for (const std::size_t c : chosen_) {
            is_taken_[c] = true;
            sum_ += information_[c];
        }
    }

    /// Until no exchange of one run makes the determinant larger.
    void run() {
        bool has_changed = true;
        while (has_changed) {
            has_changed = false;
            for (std::size_t& place : chosen_) has_changed = improve(place) || has_changed;
        }
    }

    double value() const { return log_determinant(sum_); }
    const std::vector<std::size_t>& chosen() const { return chosen_; }

  private:
    bool improve(std::size_t& place) {
        const Information rest = sum_ - information_[place];
        double best = log_determinant(sum_) + tiny;
        std::size_t best_candidate = place;
        for (std::size_t c = 0; c < information_.size(); ++c) {
            if (is_taken_[c]) continue;
            const double value = log_determinant(rest + information_[c]);
            if (value <= best) continue;
            best = value;
            best_candidate = c;
        }
        if (best_candidate == place) return false;
        is_taken_[place] = false;
        is_taken_[best_candidate] = true;
        place = best_candidate;
        sum_ = rest + information_[place];
        return true;
    }

    const std::vector<Information>& information_;
    std::vector<bool> is_taken_;
    std::vector<std::size_t> chosen_;
    Information sum_;
};

RunDesign design_of(const std::vector<Candidate>& runs) {
    RunDesign design;
    const auto rows = 3 * static_cast<Eigen::Index>(runs.size());
    FitInput input{.regressors = Eigen::MatrixXd(rows, coefficient_count),
                   .force_n = Eigen::VectorXd::Zero(rows),
                   .spread_n = Eigen::VectorXd::Ones(rows)};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        design.settings.push_back(runs[i].setting);
        input.regressors.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = runs[i].regressors;
    }
    const Information information = input.regressors.transpose() * input.regressors;
    design.determinant = std::max(0.0, information.determinant());
    design.condition = scaled_condition(input);
    constexpr double lost = 1e6;  // far below where rounding makes an inverse worthless
    design.uncertainty = design.condition < lost
                             ? Coefficients(information.inverse().diagonal().cwiseSqrt())
                             : Coefficients::Constant(std::numeric_limits<double>::infinity());
    if (design.condition >= lost) design.determinant = 0.0;
    return design;
}

double middle_of(const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
}

}  // namespace

std::vector<Candidate> candidates_of(const RunLattice& lattice) {
    std::vector<Candidate> candidates;
    for (const double diameter_mm : lattice.diameters_mm)
        for (const double depth_mm : lattice.depths_mm)
            for (const double tilt_deg : lattice.tilts_deg)
                for (const double direction_deg : directions_of(lattice, tilt_deg))
                    if (depth_mm <= 0.5 * diameter_mm)
                        add_feeds(lattice,
                                  {.diameter_mm = diameter_mm,
                                   .edges = lattice.edges,
                                   .turns = lattice.turns,
                                   .depth_mm = depth_mm,
                                   .tilt_deg = tilt_deg,
                                   .tilt_direction_deg = direction_deg},
                                  candidates);
    return candidates;
}

RunDesign optimal_design(const std::vector<Candidate>& candidates, int runs, std::uint64_t seed, int starts) {
    if (runs < 3)
        throw std::runtime_error(fmt::format("{} runs cannot give six coefficients; at least 3", runs));
    if (candidates.size() < static_cast<std::size_t>(runs))
        throw std::runtime_error(
            fmt::format("the lists make {} settings (none is deeper than the burr's radius) for {} runs: add "
                        "values to a list, or ask for fewer runs",
                        candidates.size(), runs));
    const Coefficients scale = column_scale(candidates);
    std::vector<Information> information;
    for (const Candidate& c : candidates) {
        const RunRegressors scaled = c.regressors * scale.cwiseInverse().asDiagonal();
        information.push_back(scaled.transpose() * scaled);
    }
    std::mt19937_64 random(seed);
    double best = -std::numeric_limits<double>::infinity();
    std::vector<std::size_t> chosen;
    for (int start = 0; start < starts; ++start) {
        Exchange exchange(information, runs, random);
        exchange.run();
        if (exchange.value() <= best) continue;
        best = exchange.value();
        chosen = exchange.chosen();
    }
    std::sort(chosen.begin(), chosen.end());
    std::vector<Candidate> taken;
    for (const std::size_t c : chosen) taken.push_back(candidates[c]);
    const RunDesign design = design_of(taken);
    refuse_one_feed(design.settings);
    if (!(design.condition <= largest_condition))
        throw std::runtime_error(
            fmt::format("no {} of these settings tell the six coefficients apart (condition {:.3g}, at most "
                        "{:g} is accepted): feeds of a revolution, depths and tilts must vary",
                        runs, design.condition, largest_condition));
    return design;
}

RunDesign one_factor_at_a_time(const RunLattice& lattice, int runs) {
    const double diameter_mm = middle_of(lattice.diameters_mm);
    const RunSetting middle{.diameter_mm = diameter_mm,
                            .edges = lattice.edges,
                            .turns = lattice.turns,
                            .rpm = middle_of(lattice.rpm),
                            .feed_mm_per_s = middle_of(lattice.feeds_mm_per_s),
                            .depth_mm = std::min(middle_of(lattice.depths_mm), 0.5 * diameter_mm)};
    std::vector<RunSetting> settings{middle};
    const auto vary = [&](double RunSetting::*factor, const std::vector<double>& values) {
        for (const double value : values) {
            RunSetting s = middle;
            s.*factor = value;
            if (value != middle.*factor && s.depth_mm <= 0.5 * s.diameter_mm) settings.push_back(s);
        }
    };
    vary(&RunSetting::diameter_mm, lattice.diameters_mm);
    vary(&RunSetting::feed_mm_per_s, lattice.feeds_mm_per_s);
    vary(&RunSetting::rpm, lattice.rpm);
    vary(&RunSetting::depth_mm, lattice.depths_mm);
    for (const double tilt_deg : lattice.tilts_deg)
        for (const double direction_deg : directions_of(lattice, tilt_deg)) {
            RunSetting s = middle;
            s.tilt_deg = tilt_deg;
            s.tilt_direction_deg = direction_deg;
            if (tilt_deg != 0.0) settings.push_back(s);
        }
    std::vector<Candidate> taken;
    for (std::size_t i = 0; i < static_cast<std::size_t>(runs); ++i) {
        const RunSetting& s = settings[i % settings.size()];
        taken.push_back({s, regressors_of(s)});
    }
    return design_of(taken);
}

double efficiency(const RunDesign& design, const RunDesign& other) {
    return std::pow(design.determinant / other.determinant, 1.0 / coefficient_count);
}

}  // namespace osteomill::study
