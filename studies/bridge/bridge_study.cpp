#include "studies/bridge/bridge_study.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/study_run.h"
#include "common/statistics/percentile.h"
#include "studies/bridge/private_network.h"
#include "studies/bridge/round_trips.h"

namespace osteomill::study {

namespace {

struct BridgeStudyOptions {
    std::filesystem::path out = "study/bridge";
    double seconds = 20.0;  ///< a way
    bool quick = false;
};

nlohmann::ordered_json in_numbers(const std::vector<double>& trips_us) {
    return {{"count", trips_us.size()},
            {"p50_us", percentile(trips_us, 0.5)},
            {"p99_us", percentile(trips_us, 0.99)},
            {"p999_us", percentile(trips_us, 0.999)}};
}

/// A way to the arm.
struct Way {
    std::string name;
    Ends ends{};
    bool is_between_namespaces = false;

    static std::string name_of(const Way& way) { return way.name; }
};

std::vector<Way> ways() {
    const BridgePath path{fmt::format("/tmp/osteomill_study_{}", getpid())};
    const BridgeAddress udp = ListenAddress{.port = 17020};
    std::vector<Way> all{{"Unix socket", {.where = path}},
                         {"Unix socket, key", {.where = path, .has_key = true}},
                         {"UDP, loopback", {.where = udp}},
                         {"UDP, loopback, key", {.where = udp, .has_key = true}}};
    if (PrivateNetwork::why_not().empty())
        all.push_back({.name = "UDP, two namespaces, key", .is_between_namespaces = true});
    return all;
}

RoundTrips trips_over(const Way& way, double seconds) {
    if (!way.is_between_namespaces) return measure_round_trips(way.ends, seconds);
    const PrivateNetwork network;
    return measure_round_trips(
        {.where = ListenAddress{.address = PrivateNetwork::server_address, .port = 17020},
         .server_namespace = network.server(),
         .arm_namespace = network.client(),
         .has_key = true},
        seconds);
}

void run_bridge_study(const BridgeStudyOptions& options, const StudySurroundings& surroundings) {
    StudyRun run(options.out, surroundings);
    const std::vector<Way> all_ways = ways();
    const auto trips =
        run.plan(all_ways, &Way::name_of, [seconds = options.quick ? 2.0 : options.seconds](const Way& way) {
            return trips_over(way, seconds);
        });
    if (!run.perform()) return;

    nlohmann::ordered_json found;
    run.say("{:<34}{:>28}{:>28}{:>12}", "", "bridge p50/p99/p99.9, us", "bare echo", "p99, times");
    auto way = all_ways.begin();
    for (const RoundTrips& measured : trips.outcomes()) {
        const auto row = [](const std::vector<double>& us) {
            return fmt::format("{:.0f} / {:.0f} / {:.0f}", percentile(us, 0.5), percentile(us, 0.99),
                               percentile(us, 0.999));
        };
        const double times = percentile(measured.bridge_us, 0.99) / percentile(measured.echo_us, 0.99);
        run.say("{:<34}{:>28}{:>28}{:>12.2f}", way->name, row(measured.bridge_us), row(measured.echo_us),
                times);
        found[way->name] = {{"bridge", in_numbers(measured.bridge_us)},
                            {"echo", in_numbers(measured.echo_us)},
                            {"p99_ratio", times}};
        ++way;
    }
    if (const std::string why_not = PrivateNetwork::why_not(); !why_not.empty())
        run.say("two namespaces: left out; {}", why_not);
    run.write(found, "bridge");
}

}  // namespace

StudyCommand add_bridge(CLI::App& app) {
    const auto shared = std::make_shared<BridgeStudyOptions>();
    BridgeStudyOptions& options = *shared;
    CLI::App* bridge = app.add_subcommand(
        "bridge", "the way to an arm behind the bridge and back, beside a bare echo of the same size");
    add_out(*bridge, options.out);
    bridge->add_option("--seconds", options.seconds, "that each way is measured")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    bridge->add_flag("--quick", options.quick, "two seconds each");
    return {
        .subcommand = bridge,
        .run = [shared](const StudySurroundings& surroundings) { run_bridge_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
