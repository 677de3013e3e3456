#include "render_client/ui/start/case_shelf.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace osteomill {

namespace {

constexpr std::size_t longest_name = 60;

bool is_plain(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_' ||
           letter == '.';
}

/// The folders in `folder` that have this file, by name.
std::vector<std::filesystem::path> folders_with(const std::filesystem::path& folder, const char* file) {
    std::vector<std::filesystem::path> found;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        if (std::filesystem::is_regular_file(entry->path() / file, ignored)) found.push_back(entry->path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string for_a_file(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char letter) { return !is_plain(letter); }, '_');
    if (text.size() > longest_name) text.resize(longest_name);
    return text;
}

}  // namespace

std::filesystem::path home_of_cases() {
    const char* home = std::getenv("HOME");
    return home != nullptr && *home != '\0' ? std::filesystem::path(home) / "osteomill"
                                            : std::filesystem::absolute("osteomill");
}

std::vector<ShelvedCase> cases_in(const std::filesystem::path& folder) {
    std::vector<ShelvedCase> cases;
    for (const char* name : built_in_cases) cases.push_back({name, name});
    for (const auto& path : folders_with(folder, "case.toml"))
        cases.push_back({path.filename().string(), path.string()});
    return cases;
}

std::vector<std::filesystem::path> sessions_in(const std::filesystem::path& reports) {
    return folders_with(reports, "session.pcap");
}

std::string wrong_with_name(const std::string& name, const std::filesystem::path& folder) {
    const bool is_good =
        !name.empty() && name.size() <= longest_name && name.front() != '.' && name.front() != ' ' &&
        name.back() != ' ' &&
        std::all_of(name.begin(), name.end(), [](char letter) { return is_plain(letter) || letter == ' '; });
    if (!is_good) return "a case's name has 1 to 60 letters, digits, - _ . or blanks within";
    if (std::find(built_in_cases.begin(), built_in_cases.end(), name) != built_in_cases.end())
        return fmt::format("'{}' is built in; choose another name", name);
    std::error_code error;
    if (std::filesystem::exists(folder / name, error))
        return fmt::format("there is a case '{}' already; choose another name", name);
    return {};
}

std::filesystem::path report_folder(const std::filesystem::path& reports, const std::string& case_name,
                                    const std::string& trainee, std::time_t began) {
    std::tm local{};
    ::localtime_r(&began, &local);
    return reports / fmt::format("{}-{}-{:%Y%m%d-%H%M%S}", for_a_file(case_name),
                                 for_a_file(trainee.empty() ? "nobody" : trainee), local);
}

}  // namespace osteomill
