#include "studies/force/force_study.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "imaging/memory_estimate.h"
#include "imaging/progress.h"
#include "studies/force/contact_curves.h"
#include "studies/force/convergence.h"
#include "studies/force/force_curves.h"
#include "studies/force/memory.h"
#include "studies/force/pareto.h"
#include "studies/force/random_motions.h"
#include "studies/force/scaling.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// Measures random motions, writes their table and says how they did.
ordered_json measure_random(const RandomStudyOptions& options, const std::string& name,
                            const MillingSettings& settings, const StudySurroundings& surroundings) {
    ProgressLine line(surroundings.progress, surroundings.is_terminal, name);
    const Progress progress = line.reporter();
    std::vector<RandomResult> results;
    auto motions = random_motions(options.count, options.seed, options.voxel_mm);
    if (options.depth_mm) set_depth(motions, *options.depth_mm);
    if (options.has_edge_forces) draw_edge_forces(motions, options.seed);
    if (options.has_heads) draw_heads(motions, options.seed);
    for (const RandomMotion& motion : motions) {
        results.push_back(measure(motion, voxel_model(settings)));
        progress(static_cast<double>(results.size()) / options.count);
    }
    write_text(csv_of(results), options.out / (name + ".csv"));
    ordered_json summary{{"seed", options.seed},
                         {"voxel_mm", options.voxel_mm},
                         {"edge_forces", options.has_edge_forces},
                         {"heads", options.has_heads}};
    summary.update(summary_of(results));
    surroundings.said << fmt::format(
        "{}: {} motions of seed {}: error median {:.2f} %, 90 % within {:.2f}, 95 % within {:.2f}, 99 % "
        "within {:.2f}, worst "
        "{:.2f} %; along the surface error median {:.2f} %, 90 % within {:.2f}, ripple 90 % within {:.2f}, "
        "worst {:.2f} %; means over 10 ms there 95 % "
        "within {:.2f} %, largest step at 1 kHz {:.2f} times the mean (99 % under {:.2f})\n",
        name, results.size(), options.seed, summary["median_error_percent"].get<double>(),
        summary["p90_error_percent"].get<double>(), summary["p95_error_percent"].get<double>(),
        summary["p99_error_percent"].get<double>(), summary["max_error_percent"].get<double>(),
        summary["along_median_error_percent"].get<double>(), summary["along_p90_error_percent"].get<double>(),
        summary["ripple_p90_percent"].get<double>(), summary["ripple_max_percent"].get<double>(),
        summary["window_p95_percent"].get<double>(), summary["largest_step_max"].get<double>(),
        summary["largest_step_p99"].get<double>());
    return summary;
}

/// One run of the study: what was asked, where it goes.
class ForceStudy {
  public:
    ForceStudy(const ForceStudyOptions& options, const StudySurroundings& surroundings)
        : options_(options), surroundings_(surroundings), motions_(studied_motions(options.quick)) {}

    void run() {
        ordered_json found;
        const RandomStudyOptions random{.out = options_.out, .count = options_.quick ? 60 : 500};
        found["random"] = measure_random(random, "random", {}, surroundings_);
        found["random_partial"] =
            measure_random(random, "random_partial", {.coverage = VoxelCoverage::linear}, surroundings_);
        found["pareto"] = pareto();
        found["convergence"] = convergence();
        curves();
        found["contact"] = contact();
        found["cost"] = cost();
        found["memory"] = memory();
        write_json(found, options_.out / "force.json");
        draw();
        surroundings_.said << fmt::format("force.json, tables (CSV) and charts (SVG) are in {}\n",
                                          options_.out.string());
    }

  private:
    /// A chapter with a bar of its own.
    template <typename Work>
    auto with_progress(const std::string& title, Work&& work) const {
        ProgressLine line(surroundings_.progress, surroundings_.is_terminal, title);
        return work(line.reporter());
    }

    template <typename... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
        surroundings_.said << fmt::format(format, std::forward<Arguments>(arguments)...) << '\n';
    }

    void write(const std::string& table, const std::string& name) const {
        write_text(table, options_.out / name);
    }

    ordered_json pareto() const {
        const auto settings = pareto_settings(options_.quick);
        const auto points = with_progress("pareto", [&](const Progress& progress) {
            std::vector<ParetoPoint> measured;
            for (const ParetoSetting& setting : settings) {
                measured.push_back(measure(setting, motions_, options_.quick));
                progress(static_cast<double>(measured.size()) / static_cast<double>(settings.size()));
            }
            return measured;
        });
        write(csv_of(points, motions_), "pareto.csv");
        ordered_json json = ordered_json::array();
        for (const ParetoPoint& p : points)
            json.push_back(
                {{"family", p.setting.family},
                 {"label", p.setting.label},
                 {"voxel_mm", p.setting.voxel_mm},
                 {"milling_rate_hz", p.setting.milling_rate_hz},
                 {"is_default", p.setting.is_default},
                 {"step_us", {{"mean", p.step_us_mean}, {"p50", p.step_us_p50}, {"p99", p.step_us_p99}}},
                 {"error_percent", 100.0 * p.mean_error},
                 {"worst_ripple_percent", 100.0 * p.worst_ripple}});
        return json;
    }

    ordered_json convergence() const {
        const Convergence found = with_progress("voxel size", [&](const Progress& progress) {
            return measure_convergence(motions_, options_.quick, progress);
        });
        write(csv_of(found), "convergence.csv");
        say("error falls with voxel size to the power {:.2f} (soft voxels), {:.2f} (binary)",
            found.soft_slope, found.binary_slope);
        return {{"soft_slope", found.soft_slope}, {"binary_slope", found.binary_slope}};
    }

    void curves() const {
        const ForceCurves found = with_progress(
            "curves", [&](const Progress& progress) { return measure_curves(options_.quick, progress); });
        write(csv_of(found.depth, "depth_mm"), "curve_depth.csv");
        write(csv_of(found.feed, "feed_mm_per_s"), "curve_feed.csv");
        write(csv_of(found.rpm, "thousand_rpm"), "curve_rpm.csv");
    }

    ordered_json contact() const {
        const ContactCurves found = with_progress(
            "contact", [&](const Progress& progress) { return measure_contact(options_.quick, progress); });
        write(csv_of(found), "contact.csv");
        ordered_json json = ordered_json::array();
        for (std::size_t i = 0; i < found.models.size(); ++i)
            json.push_back({{"model", found.models[i]}, {"step_us_p50", found.step_us[i]}});
        return json;
    }

    /// 1024^3 voxels take 1 GiB, and as much again while they are copied.
    int largest_volume_voxels() const {
        if (options_.quick) return 512;
        constexpr std::uint64_t enough_bytes = 4ull << 30;
        std::ifstream meminfo("/proc/meminfo");
        if (available_memory_bytes(meminfo).value_or(enough_bytes) >= enough_bytes) return 1024;
        say("volume of 1024^3 voxels left out: less than 4 GiB of memory are free");
        return 512;
    }

    ordered_json cost() const {
        const auto by_diameter = with_progress("burr size", [&](const Progress& progress) {
            return cost_by_diameter(options_.quick, progress);
        });
        const int largest_voxels = largest_volume_voxels();
        const auto by_volume = with_progress("bone size", [&](const Progress& progress) {
            return cost_by_volume(largest_voxels, options_.quick, progress);
        });
        write(csv_of(by_diameter, "diameter_mm"), "cost_by_diameter.csv");
        write(csv_of(by_volume, "edge_voxels"), "cost_by_volume.csv");
        const auto rows = [](const std::vector<ScalingRow>& measured, const char* at) {
            ordered_json json = ordered_json::array();
            for (const ScalingRow& r : measured)
                json.push_back(
                    {{at, r.at},
                     {"crescent_us", {{"100_hz", r.crescent_100_hz_us}, {"1_khz", r.crescent_1_khz_us}}},
                     {"full_scan_us", {{"100_hz", r.scan_100_hz_us}, {"1_khz", r.scan_1_khz_us}}},
                     {"times_faster",
                      {{"100_hz", r.scan_100_hz_us / r.crescent_100_hz_us},
                       {"1_khz", r.scan_1_khz_us / r.crescent_1_khz_us}}}});
            return json;
        };
        return {{"by_diameter", rows(by_diameter, "diameter_mm")},
                {"by_volume", rows(by_volume, "edge_voxels")}};
    }

    /// The folder of trial scans, where there is one and time for it.
    std::optional<std::filesystem::path> scans() const {
        const char* const folder = std::getenv("OSTEOMILL_SCANS");
        if (folder == nullptr) {
            say("real CT skipped: OSTEOMILL_SCANS does not name the folder of trial scans");
            return std::nullopt;
        }
        if (options_.quick) {
            say("real CT skipped: --quick");
            return std::nullopt;
        }
        return folder;
    }

    ordered_json memory() const {
        const auto trial_scans = scans();
        const auto scenes = with_progress("memory", [&](const Progress& progress) {
            return weigh_scenes(trial_scans, options_.out, progress);
        });
        write(csv_of(scenes), "memory_scenes.csv");
        write(csv_of(weigh_growing_bone()), "memory_bone.csv");
        write(csv_of(weigh_growing_box()), "memory_box.csv");
        const std::vector<MemoryRow> structures = weigh_structures();
        write(csv_of(structures), "memory_structures.csv");
        for (const MemoryRow& r : structures)
            say("watching {} ({:.0f} mm^3): {:.1f} MiB, ready in {:.2f} s", r.name, r.bone_mm3, r.mebibytes,
                r.start_s);
        ordered_json json = ordered_json::array();
        for (const MemoryRow& r : scenes) {
            say("{}: {:.0f} bytes per mm^3 of bone, {:.1f} MiB, starts in {:.2f} s", r.name, r.bytes_per_mm3,
                r.mebibytes, r.start_s);
            json.push_back({{"name", r.name},
                            {"bone_mm3", r.bone_mm3},
                            {"box_mm3", r.box_mm3},
                            {"bytes_per_mm3", r.bytes_per_mm3},
                            {"mebibytes", r.mebibytes},
                            {"start_s", r.start_s}});
        }
        return json;
    }

    void draw() const {
        const std::filesystem::path scripts = chart_scripts();
        for (const char* chart : {"pareto", "curves", "contact", "convergence", "scaling", "memory"})
            draw_chart(scripts, chart, options_.out);
    }

    const ForceStudyOptions& options_;
    const StudySurroundings& surroundings_;
    std::vector<StudiedMotion> motions_;
};

}  // namespace

void run_random_motions(const RandomStudyOptions& options, const StudySurroundings& surroundings) {
    const ordered_json summary = measure_random(options, "random", {}, surroundings);
    write_json(summary, options.out / "random.json");
}

void run_force_study(const ForceStudyOptions& options, const StudySurroundings& surroundings) {
    ForceStudy(options, surroundings).run();
}

}  // namespace osteomill::study
