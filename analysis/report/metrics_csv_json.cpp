#include "analysis/report/metrics_csv_json.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/report/reference_sessions.h"
#include "common/text/csv.h"

namespace osteomill {

std::string began_text(std::int64_t unix_ns) {
    constexpr std::int64_t last_s = 253'402'300'799;  // of the year 9999
    const std::int64_t unix_s = unix_ns / 1'000'000'000;
    if (unix_s <= 0 || unix_s > last_s) return {};
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(static_cast<std::time_t>(unix_s)));
}

std::string metrics_csv(const std::vector<MetricRow>& rows) {
    std::string text = "metric,of,value,unit\n";
    for (const MetricRow& row : rows)
        text += fmt::format("{},{},{},{}\n", row.key, csv_cell(row.of),
                            row.value ? fmt::format("{:.9g}", *row.value) : "", row.unit);
    return with_utf8_mark(std::move(text));
}

namespace {

template <typename Value>
nlohmann::ordered_json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace

nlohmann::ordered_json rating_json(const RatingResult& rating) {
    nlohmann::ordered_json items = nlohmann::ordered_json::array();
    for (const RatedItem& one : rating.items) {
        nlohmann::ordered_json values = nlohmann::ordered_json::object();
        for (const AskedValue& asked : one.values) values[asked.text] = or_null(asked.value);
        items.push_back({{"name", one.item.name},
                         {"points", one.points()},
                         {"most_points", one.item.points},
                         {"is_reached", or_null(one.is_reached)},
                         {"when", one.item.when},
                         {"source", one.item.source},
                         {"values", values},
                         {"why_not", one.why_not.empty() ? nlohmann::ordered_json(nullptr)
                                                         : nlohmann::ordered_json(one.why_not)}});
    }
    return {{"points", rating.points()},
            {"most_points", rating.most_points()},
            {"undos", rating.undos},
            {"undone_mm3", rating.undone_mm3},
            {"items", items}};
}

std::string metrics_json(const SessionTrace& trace, const std::vector<MetricRow>& rows,
                         const RatingResult& rating) {
    nlohmann::ordered_json metrics;
    for (const MetricRow& row : rows)
        if (row.of.empty())
            metrics[row.key] = or_null(row.value);
        else
            metrics[row.key + "_of"][row.of] = or_null(row.value);
    nlohmann::ordered_json events = nlohmann::ordered_json::array();
    for (const ControlEvent& event : trace.events)
        events.push_back({{"time_s", event.time_s},
                          {"action", name_of(event.action)},
                          {"text", event.text},
                          {"is_refused", event.is_refused}});
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    for (const auto& [name, value] : trace.session.settings) settings[name] = value;
    const SessionInfo& session = trace.session;
    nlohmann::ordered_json json{
        {"session",
         {{"trainee", session.trainee},
          {"case", session.case_name},
          {"scene", session.scene_name},
          {"began", began_text(trace.began_unix_ns)},
          {"version", session.server_version},
          {"protocol", fmt::format("{}.{}", session.protocol_major, session.protocol_minor)},
          {"bone_checksum", fmt::format("{:016x}", trace.bone_checksum)},
          {"bone_at_start", start_conditions(trace).bone},
          {"settings", settings}}},
        {"metrics", metrics}};
    if (!rating.items.empty()) json["rating"] = rating_json(rating);
    json["events"] = events;
    json["is_complete"] = trace.ends && trace.error.empty();
    json["error"] = nullptr;
    if (!trace.error.empty()) json["error"] = trace.error;
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace osteomill
