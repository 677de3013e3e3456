#include "analysis/replay/recording_summary.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "common/text/append.h"

namespace osteomill {

namespace {

/// In whole levels of fraction, so nothing is lost to rounding. Index: tissue label; 0 for bone without one.
using Levels = std::array<std::int64_t, 256>;

Levels levels_of(const Bone& bone) {
    Levels levels{};
    for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
        const BrickFractions fractions = bone.fractions(slot);
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            levels[bone.content().tissue_in(slot, voxel)] += fractions[voxel];
    }
    return levels;
}

/// Adds the volumes that the session which ends with this bone removed. `levels`: the bone's before the
/// session; on return those of `bone`.
void add_removed(RecordingSummary& summary, const Bone& bone, Levels& levels) {
    const Levels before = std::exchange(levels, levels_of(bone));
    const auto removed_mm3 = [&](std::size_t label) {
        return static_cast<double>(before[label] - levels[label]) / 255.0 * voxel_volume_mm3(summary.grid);
    };
    double sum_mm3 = 0.0;
    for (std::size_t label = 0; label < levels.size(); ++label) sum_mm3 += removed_mm3(label);
    summary.removed_mm3 += sum_mm3;
    const std::vector<Tissue>& tissues = summary.session.tissues;
    for (const Tissue& tissue : tissues) summary.by_tissue_mm3[tissue.name] += removed_mm3(tissue.label);
    if (!tissues.empty() && removed_mm3(0) > 0.0) summary.by_tissue_mm3["unlabelled"] += removed_mm3(0);
}

void begin_session(RecordingSummary& summary, const Playhead& playhead) {
    ++summary.sessions;
    summary.session = playhead.session();
    summary.grid = playhead.bone().grid();
    summary.has_goodbye = false;
}

double per_s(std::uint64_t count, double duration_s) {
    return duration_s > 0.0 ? static_cast<double>(count) / duration_s : 0.0;
}

std::string protocol(const SessionInfo& session) {
    return fmt::format("{}.{}", session.protocol_major, session.protocol_minor);
}

}  // namespace

RecordingSummary summarise(const std::filesystem::path& file,
                           const std::function<void(const Playhead&)>& on_state) {
    RecordingSummary summary;
    Playhead playhead(file);
    begin_session(summary, playhead);
    Levels levels = levels_of(playhead.bone());
    double before_s = 0.0;
    summary.error = play_to_end(
        playhead,
        [&](double) {
            before_s = playhead.time_s();
            if (playhead.next_begins_session()) add_removed(summary, playhead.bone(), levels);
        },
        [&](Playhead::Step step) {
            if (step == Playhead::Step::state) {
                const ToolState& tool = *playhead.tool();
                if (tool.spindle_on)
                    summary.milled_s[summary.session.burrs[tool.burr].name] += playhead.time_s() - before_s;
                on_state(playhead);
            }
            if (step == Playhead::Step::new_bone) {
                begin_session(summary, playhead);
                levels = levels_of(playhead.bone());
            }
            if (step == Playhead::Step::goodbye) summary.has_goodbye = true;
        });
    add_removed(summary, playhead.bone(), levels);
    static_cast<RecordingCounts&>(summary) = playhead.counts();
    summary.duration_s = playhead.time_s();
    summary.bone_checksum = playhead.bone_checksum();
    summary.is_truncated = playhead.is_truncated();
    return summary;
}

nlohmann::ordered_json to_json(const RecordingSummary& summary) {
    nlohmann::ordered_json removed{{"total", summary.removed_mm3}};
    for (const auto& [name, mm3] : summary.by_tissue_mm3) removed.emplace(name, mm3);
    nlohmann::ordered_json burrs = nlohmann::ordered_json::array();
    for (const Burr& burr : summary.session.burrs) {
        const auto milled = summary.milled_s.find(burr.name);
        burrs.push_back({{"name", burr.name},
                         {"shape", head_shape_names[static_cast<std::size_t>(burr.head.shape)]},
                         {"diameter_mm", burr.diameter_mm},
                         {"edges", burr.edges},
                         {"spindle_rpm", 60.0 * burr.spindle_rev_per_s},
                         {"spindle_on_s", milled == summary.milled_s.end() ? 0.0 : milled->second}});
    }
    const glm::ivec3& size = summary.grid.size_voxels;
    return {{"duration_s", summary.duration_s},
            {"frames", summary.frames},
            {"protocol", protocol(summary.session)},
            {"bone_checksum", fmt::format("{:016x}", summary.bone_checksum)},
            {"removed_mm3", removed},
            {"scene", summary.session.scene_name},
            {"program_version", summary.session.server_version},
            {"sessions", summary.sessions},
            {"state_frames", summary.states},
            {"frames_per_s", per_s(summary.states, summary.duration_s)},
            {"bytes", summary.bytes},
            {"state_bytes", summary.state_bytes},
            {"bytes_per_s", per_s(summary.state_bytes, summary.duration_s)},
            {"ticks", summary.ticks},
            {"missed_ticks", summary.missed_ticks},
            {"tick_bytes", summary.tick_bytes},
            {"tick_bytes_per_s", per_s(summary.tick_bytes, summary.duration_s)},
            {"checksums_verified", summary.checksums_verified},
            {"grid", {{"size_voxels", {size.x, size.y, size.z}}, {"spacing_mm", summary.grid.spacing_mm}}},
            {"burrs", burrs},
            {"ends_with_goodbye", summary.has_goodbye},
            {"is_truncated", summary.is_truncated},
            {"case", summary.session.case_name},
            {"settings", summary.session.settings},
            {"scene_toml", summary.session.scene_toml}};
}

std::string to_text(const RecordingSummary& summary) {
    std::string text;
    const auto line = [&](const std::string& name, const std::string& what) {
        append_formatted(text, "{:<12}{}\n", name, what);
    };
    const glm::ivec3& size = summary.grid.size_voxels;
    line("scene", fmt::format("{} ({} x {} x {} voxels of {} mm)", summary.session.scene_name, size.x, size.y,
                              size.z, summary.grid.spacing_mm));
    line("recorded by", fmt::format("haptic_server {}, protocol {}", summary.session.server_version,
                                    protocol(summary.session)));
    line("duration", fmt::format("{:.3f} s{}", summary.duration_s,
                                 summary.sessions > 1 ? fmt::format(", {} sessions", summary.sessions) : ""));
    line("frames", fmt::format("{} in {:.0f} kB, {} of them states: {:.1f} a second, {:.1f} kB/s",
                               summary.frames, 1e-3 * static_cast<double>(summary.bytes), summary.states,
                               per_s(summary.states, summary.duration_s),
                               1e-3 * per_s(summary.state_bytes, summary.duration_s)));
    if (summary.session.holds_ticks)
        line("ticks",
             fmt::format(
                 "{} in {:.0f} kB of these: {:.1f} kB/s{}", summary.ticks,
                 1e-3 * static_cast<double>(summary.tick_bytes),
                 1e-3 * per_s(summary.tick_bytes, summary.duration_s),
                 summary.missed_ticks > 0 ? fmt::format("; {} are missing", summary.missed_ticks) : ""));
    for (const auto& [name, milled_s] : summary.milled_s)
        line("burr", fmt::format("{}, spindle on for {:.1f} s", name, milled_s));
    line("removed", fmt::format("{:.3f} mm^3", summary.removed_mm3));
    for (const auto& [name, mm3] : summary.by_tissue_mm3) line("", fmt::format("{:.3f} mm^3 {}", mm3, name));
    line("bone",
         fmt::format("{:016x}; {} checksums hold", summary.bone_checksum, summary.checksums_verified));
    if (!summary.has_goodbye)
        line("end", summary.is_truncated
                        ? "within a frame, as after a crash or on a full disk"
                        : "without a goodbye: it goes on elsewhere, or the server was killed");
    return text;
}

}  // namespace osteomill
