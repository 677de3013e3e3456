#include "studies/bridge/bridge_study.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>

#include "analysis/output/output_files.h"
#include "common/statistics/percentile.h"
#include "studies/bridge/delay_rows.h"
#include "studies/bridge/private_network.h"
#include "studies/bridge/round_trips.h"

namespace osteomill::study {

namespace {

nlohmann::ordered_json in_numbers(const std::vector<double>& trips_us) {
    return {{"count", trips_us.size()},
            {"p50_us", percentile(trips_us, 0.5)},
            {"p99_us", percentile(trips_us, 0.99)},
            {"p999_us", percentile(trips_us, 0.999)}};
}

}  // namespace

void run_bridge_study(const BridgeStudyOptions& options, const StudySurroundings& surroundings) {
    make_folder(options.out);
    const double seconds = options.quick ? 2.0 : options.seconds;
    nlohmann::ordered_json found;
    surroundings.said << fmt::format("{:<34}{:>28}{:>28}{:>12}\n", "", "bridge p50/p99/p99.9, us",
                                     "bare echo", "p99, times");
    const auto measure = [&](const std::string& name, const Ends& ends) {
        const RoundTrips trips = measure_round_trips(ends, seconds);
        const auto row = [](const std::vector<double>& us) {
            return fmt::format("{:.0f} / {:.0f} / {:.0f}", percentile(us, 0.5), percentile(us, 0.99),
                               percentile(us, 0.999));
        };
        const double times = percentile(trips.bridge_us, 0.99) / percentile(trips.echo_us, 0.99);
        surroundings.said << fmt::format("{:<34}{:>28}{:>28}{:>12.2f}\n", name, row(trips.bridge_us),
                                         row(trips.echo_us), times);
        found[name] = {{"bridge", in_numbers(trips.bridge_us)},
                       {"echo", in_numbers(trips.echo_us)},
                       {"p99_ratio", times}};
    };
    const BridgePath path{fmt::format("/tmp/osteomill_study_{}", getpid())};
    const BridgeAddress udp = ListenAddress{.port = 17020};
    measure("Unix socket", {.where = path});
    measure("Unix socket, key", {.where = path, .has_key = true});
    measure("UDP, loopback", {.where = udp});
    measure("UDP, loopback, key", {.where = udp, .has_key = true});
    if (const std::string why_not = PrivateNetwork::why_not(); why_not.empty()) {
        const PrivateNetwork network;
        measure("UDP, two namespaces, key",
                {.where = ListenAddress{.address = PrivateNetwork::server_address, .port = 17020},
                 .server_namespace = network.server(),
                 .arm_namespace = network.client(),
                 .has_key = true});
    } else {
        surroundings.said << "two namespaces: left out; " << why_not << '\n';
    }
    surroundings.said << fmt::format("\n{:<34}{:>28}{:>28}{:>12}\n", "there and back, +- 25 %",
                                     "stable, all of the stiffness", "what the server takes", "share");
    for (const DelayRow& row : delay_rows(options.quick, [](double) {})) {
        surroundings.said << fmt::format("{:<34}{:>28}{:>28}{:>12.2f}\n", fmt::format("{} ms", row.bridge_ms),
                                         fmt::format("{} of {}", row.stable_with_all, row.cases),
                                         fmt::format("{} of {}", row.stable_with_share, row.cases),
                                         row.share);
        found["delays"].push_back({{"bridge_ms", row.bridge_ms},
                                   {"cases", row.cases},
                                   {"stable_with_all", row.stable_with_all},
                                   {"stable_with_share", row.stable_with_share},
                                   {"share", row.share}});
    }
    write_json(found, options.out / "bridge.json");
}

}  // namespace osteomill::study
