#include "render_client/ui/start/kept_sessions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "common/files/input_file.h"
#include "common/files/output_place.h"
#include "common/scene/scene.h"
#include "common/text/foreign_json.h"
#include "common/text/foreign_text.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

namespace fs = std::filesystem;

std::string month(int number) {
    const std::array names{tr("January"),   tr("February"), tr("March"),    tr("April"),
                           tr("May"),       tr("June"),     tr("July"),     tr("August"),
                           tr("September"), tr("October"),  tr("November"), tr("December")};
    return names[static_cast<std::size_t>(number - 1)];
}

std::string words_of_time(int day, int month_number, const std::string& hour_and_minute) {
    return trf("{} {} {}", day, month(month_number), hour_and_minute);
}

/// A folder's name, parsed: "CASE-TRAINEE", and the local time as text.
struct NamedFolder {
    std::string whose;
    std::string when;
};

std::optional<NamedFolder> parts_of(const std::string& name) {
    constexpr std::string_view pattern = "-YYYYmmdd-HHMMSS";
    if (name.size() <= pattern.size()) return std::nullopt;
    const std::string stamp = name.substr(name.size() - pattern.size());
    for (std::size_t i = 0; i < pattern.size(); ++i)
        if ((pattern[i] == '-') != (stamp[i] == '-') ||
            (pattern[i] != '-' && (stamp[i] < '0' || stamp[i] > '9')))
            return std::nullopt;
    const int month_number = std::stoi(stamp.substr(5, 2));
    if (month_number < 1 || month_number > 12) return std::nullopt;
    return NamedFolder{name.substr(0, name.size() - pattern.size()),
                       words_of_time(std::stoi(stamp.substr(7, 2)), month_number,
                                     stamp.substr(10, 2) + ":" + stamp.substr(12, 2))};
}

/// "Anna, jaw" of "jaw-Anna", if the case is built in; a name of another may have dashes of its own.
std::string without_dashes(const std::string& whose) {
    for (const std::string_view name : phantom_names) {
        const std::string of = std::string(name) + "-";
        if (whose.size() > of.size() && whose.starts_with(of)) {
            const std::string trainee = whose.substr(of.size());
            return (trainee == "nobody" ? tr("nobody") : trainee) + ", " + tr(std::string(name));
        }
    }
    return whose;
}

/// "14 of 20 points", and how often something was undone for them; empty if the case has no rating.
std::string rating_text(const nlohmann::json& metrics) {
    const auto number = [&](const char* key) {
        const auto found = metrics.find(key);
        return found != metrics.end() && found->is_number() ? std::optional(found->get<double>())
                                                            : std::nullopt;
    };
    const auto points = number("rating_points");
    const auto most = number("rating_most_points");
    if (!points || !most) return {};
    std::string text = trf("{:g} of {:g} points", *points, *most);
    if (const double undos = number("undos").value_or(0.0); undos > 0.0)
        text += undos == 1.0 ? tr(" (undone once)") : trf(" (undone {:g} times)", undos);
    return text;
}

/// The local time of "2026-11-28 13:05 UTC"; empty for another text.
std::string local_time_words(const std::string& utc) {
    std::tm time{};
    std::istringstream text(utc);
    if (!(text >> std::get_time(&time, "%Y-%m-%d %H:%M UTC"))) return {};
    const std::time_t seconds = ::timegm(&time);
    if (::localtime_r(&seconds, &time) == nullptr) return {};
    return words_of_time(time.tm_mday, time.tm_mon + 1,
                         fmt::format("{:02}:{:02}", time.tm_hour, time.tm_min));
}

struct SaidByReport {
    std::string whose{};  ///< "Anna, jaw"
    std::string when{};
    std::string verdict{};
};

/// Empty texts if there is no report of ours.
SaidByReport said_by_report(const fs::path& folder) {
    try {
        const auto json = parse_foreign_json(read_text(folder / "metrics.json", json_kind), "");
        const auto& session = json.at("session");
        std::string trainee = session.at("trainee").get<std::string>();
        std::string of = session.at("case").get<std::string>();
        if (of.empty()) of = session.at("scene").get<std::string>();
        const auto& metrics = json.at("metrics");
        std::string verdict;
        if (const auto passed = metrics.find("passed"); passed != metrics.end() && passed->is_number())
            verdict = passed->get<double>() != 0.0 ? tr("passed") : tr("not passed");
        if (const std::string points = rating_text(metrics); !points.empty())
            verdict += (verdict.empty() ? "" : ", ") + points;
        if (trainee.empty()) trainee = tr("nobody");
        return {one_line(trainee + ", " + tr(of)), local_time_words(session.value("began", "")), verdict};
    } catch (const std::exception&) {
        return {};
    }
}

std::optional<fs::path> recording_in(const fs::path& folder) {
    std::error_code ignored;
    for (const char* name : {"session.pcap", "session.part.pcap", "session.torn-1.pcap"})
        if (fs::is_regular_file(folder / name, ignored)) return folder / name;
    return std::nullopt;
}

}  // namespace

std::string title_of_session(const fs::path& folder) {
    const std::string name = folder.filename().string();
    const auto named = parts_of(name);
    const SaidByReport report = said_by_report(folder);
    std::string title =
        !report.whose.empty() ? report.whose : one_line(named ? without_dashes(named->whose) : name);
    if (const std::string when = named && report.when.empty() ? named->when : report.when; !when.empty())
        title += ", " + when;
    if (!report.verdict.empty()) title += ", " + report.verdict;
    return title;
}

std::vector<KeptSession> sessions_in(const fs::path& reports, std::size_t most_titled) {
    std::vector<std::pair<fs::file_time_type, KeptSession>> found;
    std::error_code error;
    for (fs::directory_iterator entry(reports, error), end; !error && entry != end; entry.increment(error)) {
        const auto recording = recording_in(entry->path());
        if (!recording) continue;
        std::error_code ignored;
        found.push_back({fs::last_write_time(*recording, ignored),
                         {.folder = entry->path(),
                          .recording = *recording,
                          .is_whole = recording->filename() == "session.pcap",
                          .has_report = fs::exists(entry->path() / "report.html", ignored),
                          .is_under_way = is_reserved(entry->path() / "report.html")}});
    }
    std::ranges::sort(found, [](const auto& a, const auto& b) {
        return std::pair(b.first, a.second.folder) < std::pair(a.first, b.second.folder);
    });
    std::vector<KeptSession> sessions;
    for (auto& [written, session] : found) {
        if (sessions.size() < most_titled) session.title = title_of_session(session.folder);
        sessions.push_back(std::move(session));
    }
    return sessions;
}

}  // namespace osteomill
