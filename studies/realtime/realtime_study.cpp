#include "studies/realtime/realtime_study.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "common/program/child_program.h"
#include "common/program/option_checks.h"
#include "studies/realtime/installed_program.h"
#include "studies/realtime/slices.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

struct RealtimeStudyOptions {
    std::filesystem::path out = "study/realtime";
    bool quick = false;         ///< 9 s in slices of 3: under a minute and a half, and no measure of a tail
    double duration_s = 600.0;  ///< that each is measured, without load and again under it; whole slices
};

constexpr double most_times_cyclictest = 1.5;
constexpr double more_late_ticks_share = 1e-5;
constexpr double bar_quantile = 0.999;
constexpr double period_us = 1000.0;

/// Everybody's ordinary work: every processor, memory and the network, until it is gone.
class Stress {
  public:
    Stress(const std::filesystem::path& stress_ng, double longest_s)
        : program_({stress_ng.string(), "--quiet", "--cpu", "0", "--vm", "1", "--vm-bytes", "128M", "--sock",
                    "1", "--timeout", fmt::format("{:.0f}", longest_s)},
                   std::chrono::seconds(10)) {}

    bool is_running() {
        program_.poll();
        return program_.is_running();
    }

  private:
    ChildProgram program_;
};

/// What was measured without load, or under it.
struct Measured {
    std::string load{};
    Served served{};
    Latencies cyclictest{};  ///< none where that is not installed
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measured, load, served, cyclictest)

/// One in turn with the other.
struct Slice {
    int number;
    std::string load;
};

ordered_json json_of(const Latencies& latencies) {
    ordered_json json;
    json["count"] = latencies.count();
    for (const auto& [name, share] :
         {std::pair{"p50", 0.5}, {"p99", 0.99}, {"p999", 0.999}, {"p9999", 0.9999}})
        json[name] = latencies.quantile_us(share);
    json["max"] = latencies.max_us();
    json["over_1_ms"] = latencies.over(period_us);
    return json;
}

/// Wakes of cyclictest over a millisecond, of as many as there were ticks, and one tick in a hundred
/// thousand.
double allowed_late_ticks(const Measured& m) {
    const auto ticks = static_cast<double>(m.served.ticks);
    const double over = static_cast<double>(m.cyclictest.over(period_us));
    return over * ticks / static_cast<double>(m.cyclictest.count()) + more_late_ticks_share * ticks;
}

ordered_json json_of(const Measured& m) {
    ordered_json json{{"load", m.load},
                      {"wakeup_latency_us", json_of(m.served.wakeup)},
                      {"haptic_tick_us", json_of(m.served.haptic_tick)},
                      {"milling_step_us", json_of(m.served.milling_step)},
                      {"ticks", m.served.ticks},
                      {"late_ticks", m.served.late_ticks},
                      {"missed_deadlines", m.served.missed_deadlines},
                      {"missed_milling_steps", m.served.missed_milling_steps},
                      {"page_faults", m.served.page_faults},
                      {"overrun_faults", m.served.overruns},
                      {"client_frames", m.served.client_frames},
                      {"removed_mm3", m.served.removed_mm3},
                      {"real_time_priority", m.served.has_priority},
                      {"memory_locked", m.served.has_locked_memory}};
    json["cyclictest_us"] = nullptr;
    if (m.cyclictest.count() == 0) return json;
    json["cyclictest_us"] = json_of(m.cyclictest);
    json["p999_times_cyclictest"] =
        m.served.wakeup.quantile_us(bar_quantile) / m.cyclictest.quantile_us(bar_quantile);
    json["allowed_late_ticks"] = allowed_late_ticks(m);
    return json;
}

class RealtimeStudy {
  public:
    RealtimeStudy(const RealtimeStudyOptions& options, const StudySurroundings& surroundings)
        : options_(options),
          run_(options.out, surroundings),
          haptic_server_(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "haptic_server"),
          cyclictest_(installed_program("cyclictest")),
          stress_ng_(installed_program("stress-ng")),
          slice_s_(options.quick ? 3.0 : 10.0),
          slices_(static_cast<int>(std::ceil((options.quick ? 9.0 : options.duration_s) / slice_s_))) {
        if (!std::filesystem::exists(haptic_server_))
            throw std::runtime_error(haptic_server_.string() + ": is not there; build it, too");
    }

    void run() {
        if (!cyclictest_) say("cyclictest is not installed (package rt-tests): nothing to compare with");
        Table table({"load", "what", "from_us", "up_to_us", "share", "share_above"});
        ordered_json found = ordered_json::array();
        std::vector<std::string> loads{"no load"};
        if (stress_ng_)
            loads.emplace_back("stress-ng");
        else
            say("stress-ng is not installed (package stress-ng): not measured under load");
        std::vector<Slice> slices;
        for (const std::string& load : loads)
            for (int number = 1; number <= slices_; ++number) slices.push_back({number, load});
        const auto planned = run_.plan(
            slices, [](const Slice& slice) { return fmt::format("{}, slice {}", slice.load, slice.number); },
            [this](const Slice& slice) { return measure(slice); });
        if (!run_.perform()) return;
        const auto take = [&](const Measured& measured) {
            report(measured);
            found.push_back(json_of(measured));
            add_bins(table, measured.served.wakeup, measured.load, "wakeup");
            add_bins(table, measured.served.haptic_tick, measured.load, "haptic tick");
            add_bins(table, measured.served.milling_step, measured.load, "milling step");
            add_bins(table, measured.cyclictest, measured.load, "cyclictest");
        };
        const std::vector<Measured> outcomes = planned.outcomes();
        for (const std::string& load : loads) {
            Measured all{.load = load};
            for (const Measured& slice : outcomes) {
                if (slice.load != load) continue;
                all.served.add(slice.served);
                all.cyclictest.add(slice.cyclictest);
            }
            take(all);
        }
        run_.write(table, "latencies");
        run_.write(found, "realtime");
        run_.draw({"realtime"});
        say("realtime.json, latencies.csv and realtime.svg are in {}", options_.out.string());
    }

  private:
    template <typename... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
        run_.say(format, std::forward<Arguments>(arguments)...);
    }

    Measured measure(const Slice& slice) const {
        const std::filesystem::path work = options_.out / fmt::format("{}-{}", slice.load, slice.number);
        make_folder(work);
        std::optional<Stress> stress;
        if (slice.load == "stress-ng") stress.emplace(*stress_ng_, 2.0 * (slice_s_ + 60.0));
        Measured measured{.load = slice.load, .served = serve(haptic_server_, slice_s_, work)};
        if (cyclictest_)
            measured.cyclictest = cycle(*cyclictest_, slice_s_, measured.served.has_priority, work);
        if (stress && !stress->is_running())
            throw std::runtime_error("stress-ng ended by itself: the load was not there");
        std::filesystem::remove_all(work);
        return measured;
    }

    void report(const Measured& m) const {
        if (!m.served.has_priority)
            say("{}: without real-time priority, so cyclictest as well; see README on how to grant it",
                m.load);
        say("{}: {} ticks, wake-up p99.9 {:.1f} us, tick p99.9 {:.1f} us; {} late by 1 ms, {} deadlines "
            "missed, {} page faults",
            m.load, m.served.ticks, m.served.wakeup.quantile_us(bar_quantile),
            m.served.haptic_tick.quantile_us(bar_quantile), m.served.late_ticks, m.served.missed_deadlines,
            m.served.page_faults);
        if (m.cyclictest.count() == 0) return;
        say("{}: cyclictest {} wake-ups, p99.9 {:.1f} us, {} over 1 ms; wake-up p99.9 is {:.2f} times that "
            "(bar: {}), late ticks {} (bar: {:.1f})",
            m.load, m.cyclictest.count(), m.cyclictest.quantile_us(bar_quantile),
            m.cyclictest.over(period_us),
            m.served.wakeup.quantile_us(bar_quantile) / m.cyclictest.quantile_us(bar_quantile),
            most_times_cyclictest, m.served.late_ticks, allowed_late_ticks(m));
    }

    const RealtimeStudyOptions& options_;
    StudyRun run_;
    std::filesystem::path haptic_server_;
    std::optional<std::filesystem::path> cyclictest_;
    std::optional<std::filesystem::path> stress_ng_;
    double slice_s_;
    int slices_;
};

void run_realtime_study(const RealtimeStudyOptions& options, const StudySurroundings& surroundings) {
    require_charts_of(surroundings);
    RealtimeStudy(options, surroundings).run();
}

}  // namespace

StudyCommand add_realtime(CLI::App& app) {
    const auto shared = std::make_shared<RealtimeStudyOptions>();
    RealtimeStudyOptions& options = *shared;
    CLI::App* realtime = app.add_subcommand("realtime",
                                            "how late the haptic loop wakes and how long it takes, in turns "
                                            "with cyclictest; then under stress-ng");
    add_out(*realtime, options.out);
    CLI::Option* const duration =
        realtime
            ->add_option("--duration-s", options.duration_s,
                         "how long each of the two is measured, without load and again under it")
            ->capture_default_str()
            ->check(within(10.0, 86'400.0));
    realtime->add_flag("--quick", options.quick, "9 s each: shows that it works, not how long the tail is")
        ->excludes(duration);
    return {
        .subcommand = realtime,
        .run = [shared](const StudySurroundings& surroundings) { run_realtime_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
