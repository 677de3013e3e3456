#include "haptic_server/command_line/command_line.h"

#include <fmt/format.h>

#include <stdexcept>

namespace osteomill {

namespace {

template <typename IsRight>
CLI::Validator number_that(const char* what, const char* description, const IsRight& is_right) {
    return CLI::Validator(
        [=](std::string& text) {
            double number = 0.0;
            if (!CLI::detail::lexical_cast(text, number)) return fmt::format("'{}' is no number", text);
            return is_right(number) ? std::string() : fmt::format("{} is not {}", text, what);
        },
        description);
}

}  // namespace

CLI::Validator above_zero() {
    return number_that("above 0", "POSITIVE", [](double number) { return number > 0.0; });
}

CLI::Validator not_below_zero() {
    return number_that("0 or more", "NONNEGATIVE", [](double number) { return number >= 0.0; });
}

std::optional<std::string> parse_or_text(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return app.help();
    } catch (const CLI::CallForVersion&) {
        return app.version() + "\n";
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(fmt::format("{}; see --help", error.what()));
    }
    return std::nullopt;
}

}  // namespace osteomill
