#include "analysis/report/reference_sessions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "analysis/report/headlines.h"
#include "analysis/report/metrics_csv_json.h"
#include "common/files/input_file.h"
#include "common/statistics/percentile.h"
#include "common/text/csv.h"
#include "common/text/foreign_json.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

/// Settings of the session (session_settings.h) that are felt. The burr at the start is not one of them: a
/// trainee changes it.
constexpr std::array<std::string_view, 8> felt{"coupling", "device",          "force_model", "force_scale",
                                               "grip",     "milling_rate_hz", "rpm",         "vibration"};

/// Sums do not depend on which empty bricks are stored.
std::uint64_t sum_of(const BoneContent& content, const std::vector<ByteBrick>& bricks) {
    std::uint64_t sum = 0;
    for (std::size_t slot = 0; slot < bricks.size(); ++slot)
        sum += checksum_of_brick(content.brick_of_slot[slot], bricks[slot]);
    return sum;
}

}  // namespace

std::map<std::string, std::string> felt_settings(const std::map<std::string, std::string>& settings) {
    std::map<std::string, std::string> some;
    for (const auto& [name, value] : settings) {
        const bool is_off = value.empty() || value == "none" || value == "false" || value == "0";
        if (std::ranges::find(felt, name) != felt.end() && !is_off) some.emplace(name, value);
    }
    return some;
}

StartConditions start_conditions(const SessionTrace& trace) {
    const BoneContent& content = trace.at_start.content();
    return {.bone = fmt::format("{:016x}{:016x}{:016x}", checksum(trace.at_start),
                                sum_of(content, content.tissue), sum_of(content, content.stiffness)),
            .settings = felt_settings(trace.session.settings)};
}

namespace {

/// Windows-1252 from 0x80 on; above 0x9F it is Latin-1, whose numbers are Unicode's.
constexpr std::array<char16_t, 32> windows_1252{
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const Utf8Character next = first_character(text);
        if (!next.is_utf8) return false;
        text.remove_prefix(next.bytes);
    }
    return true;
}

std::string from_windows_1252(std::string_view text) {
    std::string utf8;
    for (const char letter : text) {
        const auto byte = static_cast<std::uint8_t>(letter);
        const unsigned code = byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80U] : byte;
        if (code < 0x80) {
            utf8 += letter;
        } else if (code < 0x800) {
            utf8 += static_cast<char>(0xC0U | code >> 6U);
            utf8 += static_cast<char>(0x80U | (code & 0x3FU));
        } else {
            utf8 += static_cast<char>(0xE0U | code >> 12U);
            utf8 += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
            utf8 += static_cast<char>(0x80U | (code & 0x3FU));
        }
    }
    return utf8;
}

/// In UTF-8, each line ended by \n.
std::string spreadsheet_text(const std::filesystem::path& file) {
    std::string text = read_text(file, table_kind);
    if (!is_utf8(text) && !begins_as_utf16(text)) text = from_windows_1252(text);
    std::string lines;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_before_newline = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_before_newline) lines += text[i] == '\r' ? '\n' : text[i];
    }
    return lines;
}

/// As teachers write it.
bool are_experts(std::string group) {
    for (char& letter : group)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    constexpr std::array<std::string_view, 6> words{"expert",   "experts",  "experte",
                                                    "experten", "expertin", "expertinnen"};
    return std::ranges::find(words, group) != words.end();
}

}  // namespace

std::map<std::string, TraineeGroup> trainee_groups(const std::filesystem::path& file) {
    std::istringstream lines(spreadsheet_text(file));
    std::map<std::string, TraineeGroup> groups;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto fail = [&](const std::string& why) {
            throw std::runtime_error(printable(fmt::format("{}:{}: {}", file.string(), number, why)));
        };
        try {
            strip_line(line, ++number == 1);
        } catch (const std::runtime_error& error) {
            fail(error.what());
        }
        if (trimmed(line).empty()) continue;
        const bool has_semicolons = line.find(';') != std::string::npos;
        std::vector<std::string> cells = quoted_cells(line, has_semicolons ? ';' : ',');
        if (cells.size() < 2) fail("a line is TRAINEE,GROUP");
        // A comma may belong to a name, a semicolon does not.
        const bool is_heading = number == 1 && trimmed(cells.front()) == "trainee";
        if (cells.size() > 2 && (has_semicolons || is_heading))
            fail(fmt::format("has {} columns; a line is TRAINEE,GROUP alone", cells.size()));
        std::string group = trimmed(cells.back());
        if (are_experts(group)) group = expert_group;
        cells.pop_back();
        const std::string trainee = trimmed(fmt::format("{}", fmt::join(cells, ",")));
        if (number == 1 && trainee == "trainee" && group == "group") continue;
        if (trainee.empty() || group.empty()) fail("a line is TRAINEE,GROUP, and neither is empty");
        if (const auto [known, is_new] = groups.try_emplace(trainee, TraineeGroup{group, number});
            !is_new && known->second.group != group)
            fail(fmt::format("\"{}\" is in group \"{}\" already", trainee, known->second.group));
    }
    return groups;
}

namespace {

std::optional<double> value_of(const nlohmann::json& metrics, const std::string& key) {
    if (const auto one = metrics.find(key); one != metrics.end())
        return one->is_number() ? std::optional(one->get<double>()) : std::nullopt;
    const auto several = metrics.find(key + "_of");
    if (several == metrics.end()) return std::nullopt;
    std::optional<double> sum;
    for (const auto& value : *several)
        if (value.is_number()) sum = sum.value_or(0.0) + value.get<double>();
    return sum;
}

std::map<std::string, std::string> settings_felt_in(const nlohmann::json& session) {
    return felt_settings(session.at("settings").get<std::map<std::string, std::string>>());
}

/// The trainee's group; nothing if this session is no reference for the other.
std::optional<std::string> add(const std::filesystem::path& file, const nlohmann::json& own,
                               const std::map<std::string, TraineeGroup>& groups,
                               std::map<std::string, double>& values) {
    if (!std::filesystem::is_regular_file(file)) return std::nullopt;
    const auto json = parse_foreign_json(read_text(file, json_kind), file.string());
    const auto& session = json.at("session");
    const bool is_of_the_case =
        session.at("case") == own.at("case") && session.at("scene") == own.at("scene");
    const bool is_the_same = session.at("trainee") == own.at("trainee") &&
                             session.at("began") == own.at("began") &&
                             session.at("bone_checksum") == own.at("bone_checksum");
    if (!is_of_the_case || is_the_same || json.at("is_complete") != true) return std::nullopt;
    if (settings_felt_in(session) != settings_felt_in(own)) return std::nullopt;
    // Reports of versions that did not name the bone count as reports on the case's bone.
    if (session.value("bone_at_start", own.at("bone_at_start")) != own.at("bone_at_start"))
        return std::nullopt;
    for (const Headline& one : headlines)
        if (const auto value = value_of(json.at("metrics"), one.key)) values[one.key] = *value;
    const auto group = groups.find(session.at("trainee").get<std::string>());
    return group == groups.end() ? std::string() : group->second.group;
}

}  // namespace

std::optional<ValueBand> middle_half(std::span<const double> values) {
    if (values.size() < fewest_references) return std::nullopt;
    return ValueBand{percentile(values, 0.25), percentile(values, 0.75)};
}

ReferenceSessions reference_sessions(const std::filesystem::path& folder, const SessionTrace& trace) {
    const auto own = nlohmann::json::parse(metrics_json(trace, {})).at("session");
    const auto beside = std::filesystem::absolute(folder).lexically_normal().parent_path();
    ReferenceSessions all;
    ReferenceSessions experts{.are_experts = true};
    std::size_t expert_sessions = 0;
    try {
        std::map<std::string, TraineeGroup> groups;
        if (const auto file = beside / groups_file_name; std::filesystem::exists(file))
            groups = trainee_groups(file);
        for (const auto& entry : std::filesystem::directory_iterator(beside)) {
            std::map<std::string, double> values;
            std::optional<std::string> group;
            try {
                group = add(entry.path() / "metrics.json", own, groups, values);
            } catch (const std::exception&) {
                continue;  // no report of ours
            }
            if (!group) continue;
            for (const auto& [key, value] : values) all.values[key].push_back(value);
            if (*group != expert_group) continue;
            ++expert_sessions;
            for (const auto& [key, value] : values) experts.values[key].push_back(value);
        }
    } catch (const std::exception&) {
        return {};  // whose groups are unknown
    }
    return expert_sessions >= fewest_references ? experts : all;
}

}  // namespace osteomill
