// Checks of options for CLI11, which correct four ways of the library: error messages name no unreachable
// limit, NaN is refused, a choice is shown without C++ containers, and help is the same text each time.
// And an empty value is refused: a variable of a script that was not set must not be the default.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/text/foreign_text.h"

namespace osteomill {

/// Behind an argument "[a,b]", which is a name, although CLI11 would split it: it would make two of it if an
/// option may be given several. No argument holds this letter.
inline constexpr char whole_mark = '\1';
inline constexpr const char* without_value = "is given without a value";

/// Names the options that an option excludes in the order of the alphabet. CLI11 keeps them by address, in
/// another order in each run, and manual pages are made of this.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string text = CLI::Formatter::make_option_opts(option);
        std::vector<std::string> names;
        for (const CLI::Option* other : option->get_excludes()) names.push_back(other->get_name());
        if (names.empty()) return text;
        std::ranges::sort(names);
        const std::string label = " Excludes:";  // the last part of the message
        return fmt::format("{}{} {}", text.substr(0, text.find(label)), label, fmt::join(names, " "));
    }
};

/// Makes every option, of subcommands, too, take the mark off its value and refuse an empty one; and sets the
/// format of the help.
inline void prepare(CLI::App& app) {
    app.formatter(std::make_shared<HelpFormatter>());
    for (CLI::Option* option : app.get_options())
        option->transform([](std::string text) {
            if (text.ends_with(whole_mark)) text.pop_back();
            if (text.empty()) throw CLI::ValidationError(without_value);
            return text;
        });
    for (CLI::App* subcommand : app.get_subcommands([](CLI::App*) { return true; })) prepare(*subcommand);
}

/// Parses as CLI11 does, with two differences. It refuses arguments that are no plain text (foreign_text.h),
/// because they name files and people, and such names go into logs, reports and recordings. And it takes
/// "[a,b]" for a name. Throws CLI::ParseError.
inline void parse_arguments(CLI::App& app, int argc, const char* const* argv) {
    std::vector<std::string> arguments;
    for (int i = argc - 1; i > 0; --i) {  // as CLI11 wants them, the last first
        if (const auto why = why_not_plain(argv[i]))
            throw CLI::ValidationError(
                fmt::format("argument {}, '{}', {}; names are UTF-8 without control characters", i,
                            one_line(argv[i]), *why));
        arguments.emplace_back(argv[i]);
        // CLI11 would take the next argument for it.
        if (const std::string_view option = argv[i];
            option.starts_with("--") && option.find('=') == option.size() - 1)
            throw CLI::ValidationError(std::string(option.substr(0, option.size() - 1)), without_value);
        const std::string& text = arguments.back();
        if (text.ends_with(']') && (text.starts_with('[') || text.find("=[") != std::string::npos))
            arguments.back() += whole_mark;
    }
    prepare(app);
    if (app.get_name().empty() && argc > 0) app.name(argv[0]);
    app.parse(std::move(arguments));
}

/// An option that takes its text as typed, once for each time it is given: "[a,b]", "{}" and "-x" are names,
/// where CLI11 would read lists, nothing and an option. `texts` must outlive the parsing.
inline CLI::Option* add_texts(CLI::App& app, const std::string& option, std::vector<std::string>& texts,
                              const std::string& help) {
    return app
        .add_option(
            option, [](const CLI::results_t&) { return true; }, help)
        ->take_all()
        ->each([&texts](const std::string& text) { texts.push_back(text); });
}

/// An option whose text `take` reads. `take` refuses a value with std::invalid_argument, whose message
/// continues a line that begins with the option's name.
inline CLI::Option* add_read(CLI::App& app, const std::string& option,
                             std::function<void(const std::string&)> take, const std::string& help) {
    const auto refuse_in_words = [option, take = std::move(take)](const std::string& text) {
        try {
            take(text);
        } catch (const std::invalid_argument& wrong) {
            throw CLI::ValidationError(option, wrong.what());
        }
    };
    return app.add_option_function<std::string>(option, refuse_in_words, help);
}

inline CLI::Validator one_of(const std::vector<std::string>& names) {
    return CLI::Validator(
        [names](std::string& value) {
            if (std::find(names.begin(), names.end(), value) != names.end()) return std::string();
            return fmt::format("'{}' is not one of {}", value, fmt::join(names, ", "));
        },
        fmt::format("{}", fmt::join(names, "|")));
}

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
