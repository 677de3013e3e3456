// Style of all pages of the project, and the form of numbers and times on them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/words/translation.h"

namespace osteomill {

/// For a <style> element. On paper, A4 or Letter, whichever the printer has.
extern const char* const page_style;

/// Around the rows of a table: one that is wider than the window scrolls in a box of its own, and the page
/// does not.
inline constexpr const char* table_begin = "<div class='scroll'><table>";
inline constexpr const char* table_end = "</table></div>";

/// At most four digits that count, with the decimal sign of the chosen language; a share in % that is too
/// small to be read is 0.
std::string number_text(double value, std::string_view unit = {});

/// A metric's value as every page shows it, in its headline's unit if it is one: "87.4", "%". `unit` is the
/// metric's own.
struct ShownValue {
    std::string number;
    std::string unit;

    std::string text() const { return unit.empty() ? number : number + " " + unit; }
};
ShownValue shown_value(std::string_view key, double value, std::string_view unit = {});

/// A metric's unit as people read it: "mm³" for "mm^3", "°" for "deg".
std::string shown_unit(std::string_view unit);

/// By the clock of this machine, as a language writes it: "2026-11-23 22:40 CET", "23.11.2026, 22:40 Uhr";
/// empty if the recording holds no time.
std::string local_time_text(std::int64_t unix_ns, const std::string& language = spoken_language());

// Untrusted text (names, notes) as HTML or SVG shows it and nothing else.

/// Markup is escaped, control characters become spaces, and bytes that are no UTF-8 the replacement sign.
std::string html_text(std::string_view text);

}  // namespace osteomill
