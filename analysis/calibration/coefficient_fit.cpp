#include "analysis/calibration/coefficient_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace osteomill::study {

namespace {

using Design = Eigen::Matrix<double, Eigen::Dynamic, coefficient_count>;
using Square = Eigen::Matrix<double, coefficient_count, coefficient_count>;

constexpr Eigen::Index forces_of_a_run = 3;
constexpr double two_sided_95 = 0.975;
/// Below this share of runs that are as they should be, the spreads are not believed.
constexpr double improbable = 0.05;

Design whitened(const FitInput& input) {
    return input.spread_n.cwiseInverse().asDiagonal() * input.regressors;
}

/// The design with columns of length 1 (coefficients differ by a factor of a hundred and more), and how far
/// its directions are seen: the eigenvalues of the normal equations, which up to the largest condition that
/// is accepted are as good as a decomposition of the design (30^2 of 10^16).
class ScaledDesign {
  public:
    explicit ScaledDesign(const Design& design)
        : lengths_(design.colwise().norm().transpose()),
          columns_(design * lengths_.cwiseInverse().asDiagonal()),
          normal_(columns_.transpose() * columns_) {}

    double condition() const {
        const double least = normal_.eigenvalues()(0);
        return least > 0.0 ? std::sqrt(normal_.eigenvalues()(coefficient_count - 1) / least)
                           : std::numeric_limits<double>::infinity();
    }
    Coefficients least_seen() const { return normal_.eigenvectors().col(0); }
    /// Of the coefficients times `lengths`.
    Square covariance() const {
        const Square& v = normal_.eigenvectors();
        return v * normal_.eigenvalues().cwiseInverse().asDiagonal() * v.transpose();
    }
    const Coefficients& lengths() const { return lengths_; }
    Coefficients least_squares(const FitInput& input) const {
        const Coefficients scaled =
            covariance() * (columns_.transpose() * input.force_n.cwiseQuotient(input.spread_n));
        return scaled.cwiseQuotient(lengths_);
    }

  private:
    Coefficients lengths_;
    Design columns_;
    Eigen::SelfAdjointEigenSolver<Square> normal_;
};

bool sees_all(const Design& design) {
    return design.rows() >= coefficient_count && design.colwise().norm().minCoeff() > 0.0;
}

/// A coefficient is named where its part in the dependency is at least this share of the largest part.
constexpr double notable_part = 0.2;

/// The coefficients whose sum, weighted by `direction`, the design hardly sees.
std::vector<std::string> confounded(const Coefficients& direction) {
    const double largest = direction.cwiseAbs().maxCoeff();
    std::vector<std::string> names;
    for (Eigen::Index i = 0; i < coefficient_count; ++i)
        if (std::abs(direction(i)) >= notable_part * largest)
            names.emplace_back(coefficient_names[static_cast<std::size_t>(i)].symbol);
    return names;
}

std::string advice(const std::vector<std::string>& names) {
    bool has_chip = false;
    bool has_edge = false;
    for (const std::string& name : names) (name.ends_with('e') ? has_edge : has_chip) = true;
    if (has_chip && has_edge)
        return "chip and edge forces part when the feed of a revolution varies: add runs of other feeds or "
               "speeds";
    return "directions part when depth and tilt vary: add runs that are deeper, shallower or tilted";
}

void refuse_what_is_not_seen(const Design& design) {
    for (Eigen::Index i = 0; i < coefficient_count; ++i)
        if (!(design.col(i).norm() > 0.0))
            throw std::runtime_error(fmt::format("no run has a force that depends on {}",
                                                 coefficient_names[static_cast<std::size_t>(i)].symbol));
}

void refuse_inseparable_coefficients(const ScaledDesign& scaled) {
    if (scaled.condition() <= largest_condition) return;
    const auto names = confounded(scaled.least_seen());
    throw std::runtime_error(
        fmt::format("the runs cannot tell {} apart (condition {:.3g}, at most {:g} is accepted): {}",
                    fmt::join(names, ", "), scaled.condition(), largest_condition, advice(names)));
}

/// An interval of a coefficient stands for forces: those that its half width would make in the run where it
/// makes most.
void refuse_what_tells_nothing(const FitInput& input, const CoefficientFit& fit) {
    const double largest_n = input.force_n.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < coefficient_count; ++i) {
        const double stands_for_n = fit.half_width(i) * input.regressors.col(i).cwiseAbs().maxCoeff();
        if (stands_for_n <= largest_n) continue;
        const CoefficientName& name = coefficient_names[static_cast<std::size_t>(i)];
        throw std::runtime_error(
            fmt::format("the interval of {}, {:.3g} +- {:.3g} {}, stands for up to {:.3g} N, and no force is "
                        "above {:.3g} N: "
                        "it would tell nothing; measure more often, or larger forces",
                        name.symbol, fit.value(i), fit.half_width(i), name.unit, stands_for_n, largest_n));
    }
}

void judge_scatter(const Design& design, const FitInput& input, CoefficientFit& fit) {
    const Eigen::VectorXd residuals = input.force_n.cwiseQuotient(input.spread_n) - design * fit.value;
    fit.chi_squared = residuals.squaredNorm();
    fit.degrees_of_freedom = static_cast<int>(design.rows() - coefficient_count);
    fit.probability = boost::math::cdf(
        boost::math::complement(boost::math::chi_squared(fit.degrees_of_freedom), fit.chi_squared));
    if (fit.probability < improbable) fit.widened_by = std::sqrt(fit.chi_squared / fit.degrees_of_freedom);
}

double coverage_factor(const CoefficientFit& fit) {
    if (fit.widened_by == 1.0) return boost::math::quantile(boost::math::normal(), two_sided_95);
    return boost::math::quantile(boost::math::students_t(fit.degrees_of_freedom), two_sided_95);
}

FitInput without_run(const FitInput& input, Eigen::Index run) {
    const Eigen::Index before = forces_of_a_run * run;
    const Eigen::Index after = input.force_n.size() - before - forces_of_a_run;
    FitInput rest{.regressors = Design(before + after, coefficient_count),
                  .force_n = Eigen::VectorXd(before + after),
                  .spread_n = Eigen::VectorXd(before + after)};
    rest.regressors << input.regressors.topRows(before), input.regressors.bottomRows(after);
    rest.force_n << input.force_n.head(before), input.force_n.tail(after);
    rest.spread_n << input.spread_n.head(before), input.spread_n.tail(after);
    return rest;
}

}  // namespace

void refuse_one_feed(const std::vector<RunSetting>& settings) {
    double smallest_mm = std::numeric_limits<double>::infinity();
    double largest_mm = 0.0;
    for (const RunSetting& s : settings) {
        const double feed_per_tooth_mm = s.feed_mm_per_s / (s.rpm / 60.0) / s.edges;
        smallest_mm = std::min(smallest_mm, feed_per_tooth_mm);
        largest_mm = std::max(largest_mm, feed_per_tooth_mm);
    }
    if (largest_mm >= least_variation_of_feed * smallest_mm) return;
    throw std::runtime_error(fmt::format(
        "the feed of a tooth is {:.3g} to {:.3g} um in all runs, so chip forces (K_t, K_r, K_a) and edge "
        "forces "
        "(K_te, K_re, K_ae) cannot be told apart: the largest must be at least {:g} times the smallest",
        1000.0 * smallest_mm, 1000.0 * largest_mm, least_variation_of_feed));
}

FitInput fit_input(const std::vector<MeasuredRun>& runs) {
    const auto rows = forces_of_a_run * static_cast<Eigen::Index>(runs.size());
    FitInput input{.regressors = Design(rows, coefficient_count),
                   .force_n = Eigen::VectorXd(rows),
                   .spread_n = Eigen::VectorXd(rows)};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto row = forces_of_a_run * static_cast<Eigen::Index>(i);
        input.regressors.middleRows<forces_of_a_run>(row) = regressors_of(runs[i].setting);
        for (int axis = 0; axis < forces_of_a_run; ++axis) {
            input.force_n(row + axis) = runs[i].force_n[axis];
            input.spread_n(row + axis) = runs[i].spread_n[axis];
        }
    }
    return input;
}

double scaled_condition(const FitInput& input) {
    const Design design = whitened(input);
    return sees_all(design) ? ScaledDesign(design).condition() : std::numeric_limits<double>::infinity();
}

CoefficientFit fit_coefficients(const FitInput& input) {
    if (input.force_n.size() <= coefficient_count)
        throw std::runtime_error(fmt::format(
            "{} forces of {} runs for {} coefficients: there must be more forces than coefficients, so at "
            "least 3 runs",
            input.force_n.size(), input.force_n.size() / forces_of_a_run, coefficient_count));
    const Design design = whitened(input);
    refuse_what_is_not_seen(design);
    const ScaledDesign scaled(design);
    refuse_inseparable_coefficients(scaled);
    CoefficientFit fit;
    fit.condition = scaled.condition();
    fit.value = scaled.least_squares(input);
    judge_scatter(design, input, fit);
    const Square covariance = scaled.covariance();
    const Coefficients deviation = covariance.diagonal().cwiseSqrt();
    fit.correlation =
        deviation.cwiseInverse().asDiagonal() * covariance * deviation.cwiseInverse().asDiagonal();
    fit.uncertainty = fit.widened_by * deviation.cwiseQuotient(scaled.lengths());
    fit.half_width = coverage_factor(fit) * fit.uncertainty;
    refuse_what_tells_nothing(input, fit);
    return fit;
}

std::vector<std::optional<Eigen::Vector3d>> predictions_without_each_run(const FitInput& input) {
    std::vector<std::optional<Eigen::Vector3d>> predictions;
    for (Eigen::Index run = 0; run < input.force_n.size() / forces_of_a_run; ++run) {
        const FitInput rest = without_run(input, run);
        const Design design = whitened(rest);
        std::optional<Eigen::Vector3d>& prediction = predictions.emplace_back();
        if (!sees_all(design)) continue;
        const ScaledDesign scaled(design);
        if (scaled.condition() > largest_condition) continue;
        prediction =
            input.regressors.middleRows<forces_of_a_run>(forces_of_a_run * run) * scaled.least_squares(rest);
    }
    return predictions;
}

}  // namespace osteomill::study
