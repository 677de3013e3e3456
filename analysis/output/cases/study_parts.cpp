#include "analysis/output/cases/study_parts.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

namespace osteomill::study {

namespace {

/// An option of a command line and the words that are its values.
struct GivenOption {
    std::string name;  ///< empty: words before any option
    std::vector<std::string> words{};
};

/// "--out=x" as "--out x".
std::vector<GivenOption> options_in(const std::vector<std::string>& words) {
    std::vector<GivenOption> options{{}};
    for (const std::string& word : words) {
        if (!word.starts_with("--")) {
            options.back().words.push_back(word);
            continue;
        }
        const std::size_t equals = word.find('=');
        options.push_back({word.substr(0, equals)});
        if (equals != std::string::npos) options.back().words.push_back(word.substr(equals + 1));
    }
    return options;
}

bool says_where_or_how(const std::string& option) {
    return option == "--out" || option == "--shard" || option == "--jobs" || option == "--merge";
}

/// The words that say what is run.
std::vector<std::string> of_the_study(const std::vector<std::string>& words) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (!says_where_or_how(words[i].substr(0, equals)))
            kept.push_back(words[i]);
        else if (equals == std::string::npos)
            ++i;  // its value
    }
    return kept;
}

}  // namespace

void add_parts(CLI::App& study, StudyParts& parts, int usual_jobs) {
    study
        .add_option_function<int>(
            "--jobs", [&parts](int jobs) { parts.jobs = jobs; }, "cases that run at a time")
        ->check(CLI::Range(1, 1024))
        ->default_str(std::to_string(usual_jobs));
    CLI::Option* const shard = study.add_option_function<std::string>(
        "--shard",
        [&parts](const std::string& text) {
            try {
                parts.shard = shard_named(text);
            } catch (const std::invalid_argument& error) {
                throw CLI::ValidationError("--shard", error.what());
            }
        },
        "run part I of N only: I/N; a part that was stopped goes on where it was");
    study
        .add_option_function<std::vector<std::string>>(
            "--merge", [](const std::vector<std::string>&) {},
            "join parts that ran apart, files of cases or folders that hold them, and write the results")
        ->expected(1, -1)
        ->excludes(shard);
}

std::vector<std::string> command_line(std::vector<std::string> words, StudyParts& parts) {
    const std::vector<GivenOption> options = options_in(words);
    const auto merge = std::ranges::find(options, "--merge", &GivenOption::name);
    if (merge == options.end() || merge->words.empty()) {
        parts.command = of_the_study(words);
        return words;
    }
    for (const GivenOption& option : options)
        if (!option.name.empty() && option.name != "--merge" && option.name != "--out")
            throw std::invalid_argument("with --merge the parts say what was run: leave " + option.name +
                                        " out");
    parts.joined.emplace(std::vector<std::filesystem::path>(merge->words.begin(), merge->words.end()));
    parts.command = parts.joined->command();
    const std::string study = parts.command.empty() ? "" : parts.command.front();
    if (options.front().words != std::vector{study})
        throw std::invalid_argument("the parts are of the study '" + study + "'");
    words.erase(words.begin());
    words.insert(words.begin(), parts.command.begin(), parts.command.end());
    return words;
}

}  // namespace osteomill::study
