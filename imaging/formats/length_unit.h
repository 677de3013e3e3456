// The units in which image files state lengths, by the names that programs write.
#pragma once

#include <optional>
#include <string>

namespace osteomill {

/// Millimetres of one "mm", "um", "µm", "microns", "Centimeters", "m" and so on; nothing for a name that is
/// none of a length.
std::optional<double> mm_of_unit(const std::string& name);

/// Whether a file says of its unit that it is not known: "", "?", "none", "unknown".
bool is_unknown_unit(const std::string& name);

/// The units that are right, for messages.
inline constexpr const char* known_units = "mm, cm, m, um (microns) and nm are read";

}  // namespace osteomill
