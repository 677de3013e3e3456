// Checks of an option's number, for CLI11: in words that name no limit which nobody could reach, and deaf to
// no NaN, as the library's own are.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace osteomill {

template <typename IsRight>
CLI::Validator number_that(std::string what, std::string description, IsRight is_right) {
    return CLI::Validator(
        [what = std::move(what), is_right = std::move(is_right)](std::string& text) {
            double number = 0.0;
            if (!CLI::detail::lexical_cast(text, number)) return fmt::format("'{}' is no number", text);
            return is_right(number) ? std::string() : fmt::format("{} is not {}", text, what);
        },
        std::move(description));
}

inline CLI::Validator above_zero() {
    return number_that("above 0", "POSITIVE", [](double number) { return number > 0.0; });
}

inline CLI::Validator not_below_zero() {
    return number_that("0 or more", "NONNEGATIVE", [](double number) { return number >= 0.0; });
}

/// Both ends are right.
inline CLI::Validator within(double low, double high) {
    return number_that(fmt::format("within {} to {}", low, high), fmt::format("{} to {}", low, high),
                       [low, high](double number) { return number >= low && number <= high; });
}

}  // namespace osteomill
