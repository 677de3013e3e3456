// What faults of the link cost the loops of a real server: each fault beside the same session without it, one
// after the other, so that what else the machine does troubles both alike. Prints; asserts nothing.
//
//     link_fault_benchmark HAPTIC_SERVER [SECONDS [FAULT...]]
//
// A session: the server mills the cube with the 5 mm burr for so many seconds (20 unless said otherwise), a
// client looks on over loopback, and another has the fault. Faults of a cable need root: they happen between
// two network namespaces. Printed are the haptic loop's missed deadlines and how late it woke (99 and 99.9 %
// of ticks), the milling step's time, the most memory that the server had, and what became of the client with
// the fault: its bone at the end, how often it connected, and how old what it showed was.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "render_client/link/bone_link.h"
#include "studies/bridge/private_network.h"
#include "tests/support/child_process.h"
#include "tests/support/link_proxy.h"
#include "tests/support/stranger.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A client and what is known of it at the end.
class Watcher {
  public:
    Watcher(const std::string& address, std::uint16_t port) : link_(address, port) {}

    void poll() {
        last_ = link_.poll();
        if (last_.delay && last_.status == LinkStatus::live)
            most_delay_s_ = std::max(most_delay_s_, last_.delay->by_clocks_s);
    }
    bool is_finished() const { return last_.status == LinkStatus::finished; }
    std::string fate(const std::string& served) const {
        if (link_.bone() == nullptr) return "had no bone yet";
        const bool is_equal = fmt::format("{:016x}", checksum(*link_.bone())) == served;
        return fmt::format("bone {}, {} mismatches, connected {} x, at most {:.1f} s old",
                           is_equal        ? "equal"
                           : is_finished() ? "DIFFERS"
                                           : "was not complete when the server left",
                           last_.checksum_mismatches, last_.connections, most_delay_s_);
    }

  private:
    BoneLink link_;
    LinkUpdate last_;
    double most_delay_s_ = 0.0;
};

/// Where a session takes place.
struct Stage {
    std::uint16_t port = 0;
    study::PrivateNetwork* network = nullptr;  // none: loopback
    double seconds = 0.0;
    std::vector<std::unique_ptr<LinkProxy>> proxies{};  // outlive who comes through them
    std::vector<std::unique_ptr<Watcher>> watchers{};   // to be polled; the first has the fault

    std::string address() const {
        return network != nullptr ? study::PrivateNetwork::server_address : "127.0.0.1";
    }
    void watch(const std::string& where, std::uint16_t at) {
        watchers.push_back(std::make_unique<Watcher>(where, at));
    }
    void watch() { watch(address(), port); }
    void pass(Clock::duration time) {
        for (const auto until = Clock::now() + time; Clock::now() < until;) {
            for (const auto& watcher : watchers) watcher->poll();
            std::this_thread::sleep_for(10ms);
        }
    }
};

struct Fault {
    std::string name;
    bool needs_cable = false;
    double at_least_s = 0.0;
    /// Goes on for as long as the session does; returns when the fault is over.
    std::function<void(Stage&)> happen;
};

std::vector<Fault> faults() {
    return {
        {.name = "killed",
         .happen =
             [](Stage& stage) {
                 LinkProxy slow(stage.port, {.bytes_per_s = 100'000});
                 for (double s = 0.0; s < stage.seconds - 2.0; s += 0.2) {
                     stage.watch("127.0.0.1", slow.port());
                     stage.pass(200ms);  // within its snapshot
                     stage.watchers.pop_back();
                 }
             }},
        {.name = "cut-10s",
         .needs_cable = true,
         .at_least_s = 25.0,
         .happen =
             [](Stage& stage) {
                 stage.watch();
                 stage.pass(5s);
                 stage.network->pull_cable();
                 stage.pass(10s);
                 stage.network->plug_cable();
             }},
        {.name = "1Mbit",
         .needs_cable = true,
         .happen =
             [](Stage& stage) {
                 stage.network->limit_rate("1mbit");
                 stage.watch();
             }},
        {.name = "64kbit",
         .needs_cable = true,
         .at_least_s = 40.0,
         .happen =
             [](Stage& stage) {
                 stage.network->limit_rate("64kbit");
                 stage.watch();
             }},
        {.name = "late-and-dropped",
         .happen =
             [](Stage& stage) {
                 stage.proxies.push_back(
                     std::make_unique<LinkProxy>(stage.port, LinkQuality{.delay = 100ms, .jitter = 50ms}));
                 LinkProxy& late = *stage.proxies.back();
                 stage.watch("127.0.0.1", late.port());
                 for (double s = 5.0; s < stage.seconds - 2.0; s += 5.0) {
                     stage.pass(5s);
                     late.drop();
                 }
             }},
        {.name = "never-reads",
         .happen =
             [](Stage& stage) {
                 Stranger deaf(stage.port);
                 deaf.greet();
                 stage.pass(std::chrono::milliseconds(static_cast<int>(1000.0 * stage.seconds)));
             }},
        {.name = "32-clients",
         .happen =
             [](Stage& stage) {
                 for (int i = 0; i < 31; ++i) stage.watch();
             }},
        {.name = "scan-1000-per-min",
         .at_least_s = 60.0,
         .happen =
             [](Stage& stage) {
                 std::vector<std::unique_ptr<Stranger>> hanging_on;
                 for (int i = 0; i < static_cast<int>((stage.seconds - 2.0) / 0.06); ++i) {
                     auto stranger = std::make_unique<Stranger>(stage.port);
                     if (i % 3 == 0) stranger->say("GET / HTTP/1.0\r\n\r\n");
                     if (i % 3 == 1) hanging_on.push_back(std::move(stranger));
                     if (i == 100) stage.watch();  // must get in
                     stage.pass(60ms);
                 }
             }},
    };
}

/// To and fro over the cube's top for as long as it takes, a millimetre deep, 2 mm beside the way before.
void write_motion(const std::filesystem::path& csv, double seconds) {
    constexpr double stroke_mm = 30.0;
    constexpr double feed_mm_per_s = 6.0;
    std::ofstream out(csv);
    out << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,-15,-15,3.5,0,0,1,0\n0.5,-15,-15,3,0,0,1,1\n";
    double t_s = 1.0;
    for (int line = 0; t_s < seconds; ++line) {
        const double y_mm = -15.0 + 2.0 * (line % 16);
        const double x_mm = line % 2 == 0 ? -15.0 : 15.0;
        const double z_mm = 1.5 - line / 16;
        out << fmt::format("{},{},{},{},0,0,1,1\n", t_s, x_mm, y_mm, z_mm);
        t_s += stroke_mm / feed_mm_per_s;
        out << fmt::format("{},{},{},{},0,0,1,1\n", t_s, -x_mm, y_mm, z_mm);
        t_s += 1.0;
    }
}

/// Runs a session to its end and prints a line; `fault`: null for none.
void run_session(const std::string& server_program, const Fault& beside, const Fault* fault, double seconds) {
    const TemporaryFolder folder;
    const std::string report = (folder / "server.json").string();
    std::optional<study::PrivateNetwork> network;
    std::optional<study::PrivateNetwork::Stay> there;
    const std::string motion = (folder / "motion.csv").string();
    write_motion(motion, seconds);
    std::vector<std::string> command{server_program,
                                     "--scene",
                                     "cube",
                                     "--trajectory",
                                     motion,
                                     "--duration-s",
                                     fmt::format("{}", seconds),
                                     "--json",
                                     report,
                                     "--listen"};
    if (beside.needs_cable) {
        network.emplace();
        there.emplace(network->server());
        command.insert(command.end(), {"0.0.0.0:0", "--insecure-network"});
    } else {
        command.emplace_back("127.0.0.1:0");
    }
    ChildProcess server(command);
    const auto address = server.line_after("listening on ", 60s);
    if (!address) throw std::runtime_error("the server did not start: " + server.err());
    Stage stage{.port = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1))),
                .network = network ? &*network : nullptr,
                .seconds = seconds};
    std::atomic<bool> is_over{false};
    auto steady = std::make_unique<Watcher>("127.0.0.1", stage.port);
    std::thread watching([&] {
        for (; !steady->is_finished() && !is_over; std::this_thread::sleep_for(10ms)) steady->poll();
    });
    std::thread faulty([&] {
        std::optional<study::PrivateNetwork::Stay> here;
        if (network) here.emplace(network->client());
        if (fault != nullptr) fault->happen(stage);
        while (!is_over) stage.pass(50ms);
        stage.pass(500ms);  // what has been sent
    });
    const auto status = server.wait(std::chrono::seconds(static_cast<int>(seconds) + 60));
    is_over = true;
    faulty.join();
    watching.join();
    if (status != 0) throw std::runtime_error("the server failed: " + server.err());
    std::ifstream in(report);
    const auto json = nlohmann::json::parse(in);
    const auto& late = json.at("wakeup_latency_us");
    const std::string served = json.at("bone_checksum");
    fmt::print("{:<20}{:>7}{:>9.0f}{:>9.0f}{:>9.0f}{:>8.1f}  {}\n",
               fault != nullptr ? fault->name : "  without", json.at("missed_deadlines").get<int>(),
               late.at("p99").get<double>(), late.at("p999").get<double>(),
               json.at("milling_step_us").at("p99").get<double>(),
               1e-6 * json.at("bone").at("peak_resident_bytes").get<double>(),
               !stage.watchers.empty() ? stage.watchers.front()->fate(served) : "");
    if (const std::string fate = steady->fate(served); fate.find("equal") == std::string::npos)
        fmt::print("    the client beside it: {}\n", fate);
    std::fflush(stdout);
}

void run(const std::string& server_program, double seconds, const std::set<std::string>& wanted) {
    const std::string why_no_cable = study::PrivateNetwork::why_not();
    // A session with each fault and one without; beside its length each takes a second or two.
    constexpr double beside_s = 2.0;
    double all_s = 0.0;
    for (const Fault& fault : faults())
        if ((wanted.empty() || wanted.contains(fault.name)) && !(fault.needs_cable && !why_no_cable.empty()))
            all_s += 2.0 * (std::max(seconds, fault.at_least_s) + beside_s);
    fmt::print("takes about {:.0f} min\n", std::ceil(all_s / 60.0));
    fmt::print("{:<20}{:>7}{:>9}{:>9}{:>9}{:>8}\n", "", "missed", "woke p99", "p999 us", "step p99", "MB");
    for (const Fault& fault : faults()) {
        if (!wanted.empty() && !wanted.contains(fault.name)) continue;
        if (fault.needs_cable && !why_no_cable.empty()) {
            fmt::print("{:<20}left out: {}\n", fault.name, why_no_cable);
            continue;
        }
        const double length_s = std::max(seconds, fault.at_least_s);
        run_session(server_program, fault, nullptr, length_s);
        run_session(server_program, fault, &fault, length_s);
    }
}

}  // namespace
}  // namespace osteomill::testing

int main(int count, char** words) {
    if (count < 2) {
        fmt::print(stderr, "usage: link_fault_benchmark HAPTIC_SERVER [SECONDS [FAULT...]]\n");
        return 2;
    }
    try {
        osteomill::testing::run(words[1], count > 2 ? std::stod(words[2]) : 20.0,
                                {words + std::min(count, 3), words + count});
    } catch (const std::exception& error) {
        fmt::print(stderr, "link_fault_benchmark: {}\n", error.what());
        return 1;
    }
    return 0;
}
