// The relation of CT numbers to the relative stiffness of bone for the burr (1: the bone for which K_t, K_r,
// K_a were measured).
//
// Piecewise linear between knots. The default knots follow yield strength against ash density rho (g/cm^3),
// Keyak et al.: 137 rho^1.88 MPa up to 0.317, 114 rho^1.72 above; relative to rho = 1.6. Density is taken as
// HU / 1000, which meets both dentine (1.45 to 1.53 g/cm^3 at 1323 to 1899 HU) and enamel (2.6 to 2.8 at 2071
// to 2955 HU) within 10 %. Within cortical bone HU predicts strength poorly (Rho 1995, r^2 < 0.2): treat
// differences there as indicative. A scene may replace the knots.
#pragma once

#include <cstdint>
#include <vector>

namespace osteomill {

struct StiffnessKnot {
    double hu = 0.0;
    double relative_stiffness = 1.0;

    bool operator==(const StiffnessKnot&) const = default;
};

/// A tissue whose stiffness is independent of CT numbers.
struct TissueStiffness {
    std::uint8_t label = 0;
    double relative_stiffness = 1.0;

    bool operator==(const TissueStiffness&) const = default;
};

/// A tissue whose stiffness is a multiple of the value from CT numbers.
struct TissueFactor {
    std::uint8_t label = 0;
    double factor = 1.0;

    bool operator==(const TissueFactor&) const = default;
};

struct StiffnessRelation {
    std::vector<StiffnessKnot> knots;        ///< ascending in HU, at least one
    std::vector<TissueStiffness> tissues{};  ///< which have a stiffness of their own
    std::vector<TissueFactor> factors{};     ///< others that have a factor

    bool operator==(const StiffnessRelation&) const = default;
};

/// A voxel's 8-bit stiffness code counts these steps of relative stiffness.
inline constexpr double stiffness_per_code = 0.02;
/// The stiffest bone that a code can hold.
inline constexpr double largest_relative_stiffness = 255 * stiffness_per_code;
/// CT number of the default relation's reference bone, whose relative stiffness is 1.
inline constexpr double reference_bone_hu = 1600.0;

/// The default relation described above.
StiffnessRelation default_stiffness_relation();

/// Relative stiffness at a CT number; the end knots' values hold beyond them. The relation must be valid.
double relative_stiffness(const StiffnessRelation& relation, double hu);

/// Throws std::invalid_argument, naming the knot, unless there is one, knots ascend strictly in HU, and every
/// stiffness is finite and within [stiffness_per_code, largest_relative_stiffness].
void require_valid(const StiffnessRelation& relation);

}  // namespace osteomill
