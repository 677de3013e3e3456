#include "analysis/output/cases/kept_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "common/text/plain_text.h"
#include "common/text/words.h"

namespace osteomill::study {

namespace {

constexpr std::array not_kept{"--out", "--merge", "--shard", "--jobs", "--database", "--help"};

/// How many values an option may have still.
int room_of(const CLI::Option& option, std::size_t taken) {
    return option.get_items_expected_max() - static_cast<int>(taken);
}

/// A word may begin as an option and be a number.
bool is_option(const std::string& word) {
    return word.starts_with('-') && !finite_number(word);
}

/// Why the words behind the study's name are no options of it; empty where they are.
std::string why_not(const CLI::App& study, std::span<const std::string> words) {
    std::size_t room_without_option = 0;
    for (const CLI::Option* const option : study.get_options())
        if (option->get_positional())
            room_without_option += static_cast<std::size_t>(std::max(0, option->get_items_expected_max()));
    const CLI::Option* option = nullptr;
    std::size_t values = 0;
    for (const std::string& word : words) {
        if (!is_option(word)) {
            if (option != nullptr && room_of(*option, values) > 0)
                ++values;
            else if (room_without_option > 0)
                --room_without_option;
            else
                return "'" + word + "' is a value of no option";
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        option = name.starts_with("--") ? study.get_option_no_throw(name) : nullptr;
        if (option == nullptr || option->get_positional() ||
            std::ranges::find(not_kept, name) != not_kept.end())
            return "'" + name + "' is no option that says what is run";
        values = equals == std::string::npos ? 0 : 1;
    }
    return {};
}

}  // namespace

std::vector<std::string> command_of_study(std::span<const StudyCommand> studies,
                                          const std::vector<std::string>& kept, const std::string& file) {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(
            fmt::format("{}: it names no study that can be repeated: '{}': {}", printable(file),
                        one_line(fmt::format("{}", fmt::join(kept, " "))), one_line(why)));
    };
    const auto study = std::ranges::find_if(studies, [&](const StudyCommand& one) {
        return !kept.empty() && one.subcommand->get_name() == kept.front();
    });
    if (study == studies.end())
        fail(fmt::format("'{}' is none of the studies", kept.empty() ? "" : kept.front()));
    if (const std::string why = why_not(*study->subcommand, std::span(kept).subspan(1)); !why.empty())
        fail(why);
    return kept;
}

}  // namespace osteomill::study
