// Checks of a burr and of a command that every force model makes.
#pragma once

#include <cstddef>

#include "common/scene/burr.h"
#include "haptic_server/exchange/milling_step.h"

namespace osteomill {

/// A burr may be this many voxels across, so that what a model keeps for each of its rows has room.
inline constexpr double most_voxels_across_burr = 500.0;

/// Throws std::invalid_argument, naming the burr, unless diameter, edges and spindle speed are above zero,
/// the cutting coefficients finite and not negative, the burr no more than 500 voxels across, and its shank
/// as shank.h has it.
void require_valid(const Burr& burr, double spacing_mm);

/// Whether a command is finite, lasts, and names one of `burr_count` burrs; its axis must be of unit length.
/// Real-time safe.
bool is_usable(const BurrCommand& command, std::size_t burr_count) noexcept;

}  // namespace osteomill
