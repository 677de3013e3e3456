#include "common/scene/stiffness_relation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace osteomill {

namespace {

/// Yield strength against ash density, MPa; Keyak et al. 1994 and 1998.
double yield_mpa(double density_g_per_cm3) {
    return density_g_per_cm3 <= 0.317 ? 137.0 * std::pow(density_g_per_cm3, 1.88)
                                      : 114.0 * std::pow(density_g_per_cm3, 1.72);
}

}  // namespace

StiffnessRelation default_stiffness_relation() {
    StiffnessRelation relation;
    // Close enough that the straight pieces stay within 1 % of the power law above 300 HU.
    for (const double hu :
         {150.0,  200.0,  250.0,  317.0,  400.0,  500.0,  600.0,  700.0,  800.0,  1000.0, 1200.0,
          1400.0, 1600.0, 1800.0, 2000.0, 2250.0, 2500.0, 2750.0, 3000.0, 3500.0, 4000.0}) {
        const double strength = yield_mpa(hu / 1000.0) / yield_mpa(reference_bone_hu / 1000.0);
        relation.knots.push_back({hu, std::clamp(strength, stiffness_per_code, largest_relative_stiffness)});
    }
    return relation;
}

double relative_stiffness(const StiffnessRelation& relation, double hu) {
    const auto& knots = relation.knots;
    const auto above =
        std::upper_bound(knots.begin(), knots.end(), hu,
                         [](double value, const StiffnessKnot& knot) { return value < knot.hu; });
    if (above == knots.begin()) return knots.front().relative_stiffness;
    if (above == knots.end()) return knots.back().relative_stiffness;
    const StiffnessKnot& below = *(above - 1);
    const double share = (hu - below.hu) / (above->hu - below.hu);
    return below.relative_stiffness + share * (above->relative_stiffness - below.relative_stiffness);
}

void require_valid(const StiffnessRelation& relation) {
    if (relation.knots.empty()) throw std::invalid_argument("a stiffness relation needs at least one knot");
    for (std::size_t i = 0; i < relation.knots.size(); ++i) {
        const StiffnessKnot& knot = relation.knots[i];
        if (!std::isfinite(knot.hu) || (i > 0 && knot.hu <= relation.knots[i - 1].hu))
            throw std::invalid_argument("stiffness knot " + std::to_string(i) +
                                        " does not lie above the one before in HU");
        if (!(knot.relative_stiffness >= stiffness_per_code &&
              knot.relative_stiffness <= largest_relative_stiffness))
            throw std::invalid_argument("stiffness knot " + std::to_string(i) +
                                        " has a relative stiffness outside 0.02 to 5.1");
    }
}

}  // namespace osteomill
