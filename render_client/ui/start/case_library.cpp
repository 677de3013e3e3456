#include "render_client/ui/start/case_library.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "common/scene/scene.h"
#include "common/scene/scene_file.h"
#include "common/scene/shipped_scenes.h"
#include "common/text/foreign_text.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

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

std::string mark_in_words(std::string_view metric, double mark) {
    if (metric == "rating_share") return trf("at least {:.0f} % of the points", 100.0 * mark);
    if (metric == "time_s")
        return std::fmod(mark, 60.0) == 0.0 ? trf("at most {:.0f} min", mark / 60.0)
                                            : trf("at most {:.0f} s", mark);
    if (metric == "plan_removed_share") return trf("at least {:.0f} % of the target removed", 100.0 * mark);
    if (metric == "plan_excess_mm3") return trf("at most {:g} mm³ beside the target", mark);
    if (metric == "structure_touches")
        return mark < 1.0 ? tr("nothing touched that is protected")
                          : trf("at most {:.0f} touches of what is protected", mark);
    if (metric == "peak_force_n") return trf("at most {:g} N", mark);
    return {};
}

template <typename Read>
void describe(ShelvedCase& shelved, const Read& read) {
    try {
        const Scene scene = read();
        shelved.description = scene.description;
        std::vector<std::string> names;
        for (const Tissue& tissue : scene.tissues)
            if (tissue.is_protected) names.push_back(tissue_words(tissue.name));
        shelved.protected_names = fmt::format("{}", fmt::join(names, ", "));
        shelved.marks = marks_in_words(scene.pass);
    } catch (const SceneError& error) {
        shelved.description = error.what();
    }
}

}  // namespace

std::filesystem::path home_of_cases() {
    const char* home = std::getenv("HOME");
    return home != nullptr && *home != '\0' ? std::filesystem::path(home) / "osteomill"
                                            : std::filesystem::absolute("osteomill");
}

std::vector<ShelvedCase> cases_in(const std::filesystem::path& folder) {
    std::vector<ShelvedCase> cases;
    for (const ShippedScene& shipped : shipped_scenes) {
        const std::string name(shipped.name);
        cases.push_back({.name = name, .argument = name, .is_built_in = true});
        describe(cases.back(), [&] { return parse_scene(shipped.text, name); });
    }
    for (const auto& path : folders_with(folder, "case.toml")) {
        cases.push_back({.name = path.filename().string(), .argument = path.string()});
        describe(cases.back(), [&] { return read_scene(path / "case.toml"); });
    }
    return cases;
}

std::string marks_in_words(const PassMarks& marks) {
    std::vector<std::string> words;
    for (const PassMarkKind& kind : pass_mark_kinds)
        if (const auto mark = marks.find(kind.metric); mark != marks.end())
            words.push_back(mark_in_words(kind.metric, mark->second));
    return fmt::format("{}", fmt::join(words, ", "));
}

std::string wrong_with_name(const std::string& name, const std::filesystem::path& folder) {
    const bool is_good = !name.empty() && name == as_file_name(name) && name.front() != '.' &&
                         name.front() != ' ' && name.back() != ' ';
    if (!is_good)
        return trf("a case's name has 1 to {} characters, no / or \\, no dot first, no blank at its ends",
                   longest_file_name_characters);
    if (std::ranges::find(phantom_names, name) != phantom_names.end())
        return trf("'{}' is built in; choose another name", name);
    std::error_code error;
    if (std::filesystem::exists(folder / name, error))
        return trf("there is a case '{}' already; choose another name", name);
    return {};
}

std::filesystem::path report_folder(const std::filesystem::path& reports, const std::string& case_name,
                                    const std::string& trainee, std::time_t began) {
    std::tm local{};
    ::localtime_r(&began, &local);
    return reports / fmt::format("{}-{}-{:%Y%m%d-%H%M%S}", as_file_name(case_name),
                                 as_file_name(trainee.empty() ? "nobody" : trainee), local);
}

std::string make_folder_at_home(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    // A folder may be there on a disk that takes nothing.
    if (!error && ::access(folder.c_str(), W_OK) != 0) error.assign(errno, std::generic_category());
    if (!error) return {};
    return trf("nothing can be kept in {} ({}): whoever set this program up can name another folder for it",
               folder.string(), error.message());
}

}  // namespace osteomill
