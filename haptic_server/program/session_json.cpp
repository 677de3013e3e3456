#include "haptic_server/program/session_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "common/files/atomic_file.h"
#include "simulation/safety/fault.h"

namespace osteomill {

namespace {

nlohmann::ordered_json percentiles_us(const Histogram& histogram) {
    constexpr double us_per_s = 1e6;
    return {{"p50", us_per_s * histogram.quantile_s(0.5)},
            {"p99", us_per_s * histogram.quantile_s(0.99)},
            {"p999", us_per_s * histogram.quantile_s(0.999)},
            {"max", us_per_s * histogram.max_s()}};
}

nlohmann::ordered_json histogram_us(const Histogram& histogram) {
    constexpr double us_per_s = 1e6;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Histogram::Bucket& bucket : histogram.filled())
        json.push_back({us_per_s * bucket.up_to_s, bucket.count});
    return json;
}

nlohmann::ordered_json removed_by_name(const RemovedByTissue& removed_mm3, const Scene& scene) {
    nlohmann::ordered_json json;
    json["total"] = std::accumulate(removed_mm3.begin(), removed_mm3.end(), 0.0);
    for (const Tissue& tissue : scene.tissues) json.emplace(tissue.name, removed_mm3[tissue.label]);
    if (!scene.tissues.empty() && removed_mm3[0] > 0.0) json["unlabelled"] = removed_mm3[0];
    return json;
}

bool has_any(const RemovedByTissue& removed_mm3) {
    return std::any_of(removed_mm3.begin(), removed_mm3.end(), [](double mm3) { return mm3 > 0.0; });
}

nlohmann::ordered_json faults(const MillingSessionReport& report) {
    nlohmann::ordered_json json;
    for (const Fault fault : all_faults)
        if (fault != Fault::paused)
            json[name_of(fault)] = report.fault_counts[static_cast<std::size_t>(fault)];
    return json;
}

nlohmann::ordered_json cost(const BoneCost& bone, std::uint64_t peak_resident_bytes) {
    nlohmann::ordered_json json{{"memory_bytes", bone.memory_bytes}, {"bone_mm3", bone.bone_mm3}};
    if (bone.bone_mm3 > 0.0) json["bytes_per_mm3"] = static_cast<double>(bone.memory_bytes) / bone.bone_mm3;
    json["startup_s"] = bone.startup_s;
    json["peak_resident_bytes"] = peak_resident_bytes;
    return json;
}

}  // namespace

nlohmann::ordered_json session_json(const MillingSessionReport& report, const BoneCost& bone,
                                    std::uint64_t peak_resident_bytes, const Scene& scene,
                                    const MillingSessionOptions& options) {
    nlohmann::ordered_json json;
    json["scene"] = scene.name;
    json["clock"] = options.clock == ClockKind::real ? "real" : "virtual";
    json["coupling"] = name_of(options.coupling);
    json["milling_rate_hz"] = options.milling_rate_hz;
    json["duration_s"] = report.duration_s;
    json["ticks"] = report.haptic.ticks;
    json["real_time_priority"] = report.real_time_priority;
    json["memory_locked"] = report.memory_locked;
    json["page_faults"] = {{"haptic", report.haptic_page_faults}, {"milling", report.milling_page_faults}};
    json["missed_deadlines"] = report.haptic.missed;
    json["late_ticks"] = report.haptic.late;
    json["wakeup_latency_us"] = percentiles_us(report.haptic.wakeup_latency);
    json["haptic_tick_us"] = percentiles_us(report.haptic.duration);
    json["milling_steps"] = report.milling.ticks;
    json["missed_milling_steps"] = report.milling.missed;
    json["milling_step_us"] = percentiles_us(report.milling.duration);
    RemovedByTissue removed_in_all_mm3 = report.removed_before_mm3;
    for (std::size_t label = 0; label < removed_in_all_mm3.size(); ++label)
        removed_in_all_mm3[label] += report.removed_mm3[label];
    json["removed_mm3"] = removed_by_name(removed_in_all_mm3, scene);
    if (has_any(report.removed_before_mm3))
        json["removed_before_mm3"] = removed_by_name(report.removed_before_mm3, scene);
    json["peak_force_n"] = report.peak_force_n;
    json["solve"] = {{"max_residual_n", report.solve.max_residual_n},
                     {"fallbacks", report.solve.fallbacks},
                     {"relaxed", report.solve.relaxed},
                     {"damped", report.solve.damped}};
    json["energy_to_hand_mj"] = {{"most", report.most_energy_to_hand_mj}};
    json["faults"] = faults(report);
    json["edit_overflows"] = report.change_overflows;
    json["bone"] = cost(bone, peak_resident_bytes);
    json["bone_checksum"] = fmt::format("{:016x}", report.bone_checksum);
    return json;
}

nlohmann::ordered_json histograms_us(const MillingSessionReport& report) {
    return {{"wakeup_latency", histogram_us(report.haptic.wakeup_latency)},
            {"haptic_tick", histogram_us(report.haptic.duration)},
            {"milling_step", histogram_us(report.milling.duration)}};
}

void add_structures(nlohmann::ordered_json& json, const StructureWatch& structures, const Scene& scene) {
    if (structures.empty()) return;
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const StructureAccount& account : structures.accounts()) {
        nlohmann::ordered_json one{{"name", scene.tissues[account.last.tissue].name},
                                   {"nearest_mm", nullptr},
                                   {"touches", account.last.touches_so_far},
                                   {"first_touch_s", nullptr},
                                   {"touched_s", account.last.touched_s},
                                   {"removed_mm3", account.last.removed_mm3},
                                   {"entered_mm3", account.last.entered_mm3}};
        if (account.nearest_mm) one["nearest_mm"] = *account.nearest_mm;
        if (account.last.touches_so_far > 0) one["first_touch_s"] = account.last.first_touch_s;
        all.push_back(std::move(one));
    }
    json["structures"] = std::move(all);
    json["structures_memory_bytes"] = structures.memory_bytes();
}

nlohmann::ordered_json recorded(const RecordingReport& recording) {
    nlohmann::ordered_json json{{"file", recording.file.string()},
                                {"frames", recording.frames},
                                {"bytes", recording.bytes},
                                {"missed_ticks", recording.missed_ticks},
                                {"pauses", recording.pauses}};
    json["error"] = nullptr;
    if (!recording.error.empty()) json["error"] = recording.error;
    return json;
}

void write_json(const nlohmann::ordered_json& json, const std::filesystem::path& file) {
    write_atomic_file(file,
                      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::optional<std::uint64_t> peak_resident_bytes(std::istream& status) {
    for (std::string key; status >> key;) {
        std::uint64_t kib = 0;
        if (key == "VmHWM:" && status >> kib) return kib * 1024;
        std::getline(status, key);
    }
    return std::nullopt;
}

}  // namespace osteomill
