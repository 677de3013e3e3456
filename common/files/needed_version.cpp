#include "common/files/needed_version.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

using Version = std::array<unsigned, 3>;

/// "1" and "1.0" are 1.0.0.
std::optional<Version> version_from(std::string_view text) {
    Version version{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t part = 0; part < version.size(); ++part) {
        const auto [rest, error] = std::from_chars(at, end, version[part]);
        if (error != std::errc()) return std::nullopt;
        at = rest;
        if (at == end) return version;
        if (*at++ != '.') return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> why_not_for_this_version(std::string_view needed) {
    const std::optional<Version> version = version_from(needed);
    if (!version) return fmt::format("needs a version such as 0.3 or 0.3.1, not '{}'", printable(needed));
    if (*version <= *version_from(OSTEOMILL_VERSION)) return std::nullopt;
    return fmt::format("needs Osteomill {} or later, this is {}", needed, OSTEOMILL_VERSION);
}

}  // namespace osteomill
