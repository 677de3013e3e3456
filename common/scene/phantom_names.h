// Names of the bones made by code, in the order in which people see them.
#pragma once

#include <array>

namespace osteomill {

/// Each has a scene of its name, scenes/NAME.toml.
inline constexpr std::array phantom_names{"jaw", "mastoid", "tooth", "cube", "head"};

}  // namespace osteomill
