// Checks of a burr and of a command that every force model makes.
#pragma once

#include <cstddef>

#include "common/scene/burr.h"
#include "simulation/exchange/milling_step.h"

namespace osteomill {

/// Most voxels across a burr, so that the values a model keeps for each row fit.
inline constexpr double most_voxels_across_burr = 500.0;

/// Throws std::invalid_argument, naming the burr, unless diameter, edges and spindle speed are above zero,
/// the cutting coefficients finite and not negative, the burr no more than 500 voxels across or long, and its
/// head and shank as burr.h and shank.h have them.
void require_valid(const Burr& burr, double spacing_mm);

/// For models that know the ball alone: throws std::invalid_argument, naming burr and `model`, for any other
/// head.
void require_ball(const Burr& burr, const char* model);

/// Whether a command is finite, has a duration, and names one of `burr_count` burrs; its axis must be of unit
/// length. Real-time safe.
bool is_usable(const BurrCommand& command, std::size_t burr_count) noexcept;

}  // namespace osteomill
