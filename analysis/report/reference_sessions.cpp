#include "analysis/report/reference_sessions.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/report/headlines.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/start_conditions.h"
#include "analysis/report/trainee_groups.h"
#include "common/files/input_file.h"
#include "common/statistics/percentile.h"
#include "common/text/foreign_json.h"

namespace osteomill {

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
