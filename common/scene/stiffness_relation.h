// From CT numbers to the relative stiffness of bone for the burr (1: the bone for which K_t, K_r, K_a were
// measured).
//
// Piecewise linear between knots. The default knots follow strength against density: yield ~ rho^1.88 below
// and rho^1.72 above 0.317 g/cm^3 (Keyak), with apparent density taken linear in HU. Within cortical bone HU
// predicts strength poorly (Rho 1995, r^2 < 0.2): treat differences there as indicative; a scene may replace
// the knots.
#pragma once

#include <cstdint>
#include <vector>

namespace osteomill {

struct StiffnessKnot {
    double hu = 0.0;
    double relative_stiffness = 1.0;
};

struct StiffnessRelation {
    std::vector<StiffnessKnot> knots;  ///< ascending in HU, at least one
};

/// The default relation described above; its numbers and sources are in the .cpp.
StiffnessRelation default_stiffness_relation();

/// Relative stiffness at a CT number; the end knots' values hold beyond them.
double relative_stiffness(const StiffnessRelation& relation, double hu);

/// Throws std::invalid_argument unless knots ascend strictly in HU and every stiffness is finite and in
/// (0, 5.1], which is what a voxel's 8-bit code can hold in steps of 0.02.
void require_valid(const StiffnessRelation& relation);

}  // namespace osteomill
