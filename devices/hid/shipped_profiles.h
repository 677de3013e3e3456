// The texts of devices/*.toml, compiled in so that their names work wherever the program lies.
#pragma once

#include <span>
#include <string_view>

namespace osteomill {

struct ShippedProfile {
    std::string_view name;
    std::string_view toml;
};

std::span<const ShippedProfile> shipped_profiles();

}  // namespace osteomill
