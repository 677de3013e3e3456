// A long session of the real programs: eight clients come and go behind bad cables drawn from a seed, the
// server records, sessions on the virtual clock run beside it.
//
//     soak HAPTIC_SERVER PACKET_REPLAY MINUTES [SEED]
//
// Exits 0 if every bone is the server's at the end, the recording's too, if every session on the virtual
// clock left the same bone, and if the server's memory has not grown: its median over the last tenth of the
// time against that over the second tenth. A long run may grow by a hundredth; one of minutes, in which
// buffers reach their size, by most_growth_mib. Ticks' latencies and missed deadlines are printed tenth by
// tenth, so that a trend shows; the reader judges them, since they depend on the machine.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/link/bone_link.h"
#include "tests/support/block_file.h"
#include "tests/support/child_process.h"
#include "tests/support/eventually.h"
#include "tests/support/link_proxy.h"
#include "tests/support/scraped_metrics.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t clients = 8;
constexpr double most_growth_share = 0.01;
constexpr double most_growth_mib = 8.0;
constexpr double long_run_minutes = 30.0;
constexpr std::size_t tenths = 10;

/// Strokes over all of the block, each two seconds long and lifted clear of it, ever deeper; enough of them
/// for `minutes`.
void write_motion(const std::filesystem::path& csv, double minutes) {
    std::ofstream out(csv);
    out << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
    const int strokes = static_cast<int>(30.0 * minutes) + 30;
    for (int stroke = 0; stroke < strokes; ++stroke) {
        const double share = static_cast<double>(stroke) / strokes;
        const double x_mm = -4.0 + 8.0 * ((stroke * 37) % 100) / 100.0;
        const double y_mm = -3.0 + 6.0 * ((stroke * 61) % 100) / 100.0;
        const auto put = [&](double after_s, double z_mm, int pedal) {
            out << fmt::format("{},{},{},{},0,0,1,{}\n", 2.0 * stroke + after_s, x_mm, y_mm, z_mm, pedal);
        };
        put(0.0, 5.5, 0);
        put(0.3, 5.5, 0);
        put(0.6, 2.9, 1);
        put(1.2, 2.4 - 4.0 * share, 1);
        put(1.5, 2.9, 1);
    }
}

/// The resident memory now.
double resident_mib(pid_t pid) {
    std::ifstream statm("/proc/" + std::to_string(pid) + "/statm");
    double all = 0.0;
    double resident_pages = 0.0;
    statm >> all >> resident_pages;
    return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

double median(std::vector<double> values) {
    if (values.empty()) throw std::runtime_error("the session was too short to say anything of");
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// A client behind a cable of its own.
class Station {
  public:
    explicit Station(std::uint16_t server_port) : cable_(server_port) {}

    void poll() {
        if (link_) last_ = link_->poll();
    }
    /// One fault, or the end of one.
    const char* suffer(std::mt19937& random) {
        switch (random() % 6) {
            case 0:
                if (link_) return link_.reset(), "leaves";
                [[fallthrough]];
            case 1:
                if (!link_) link_ = std::make_unique<BoneLink>("127.0.0.1", cable_.port());
                return "comes";
            case 2:
                return cable_.cut(), "cable cut";
            case 3:
                return cable_.drop(), "hung up on";
            case 4: {
                const std::chrono::milliseconds late(random() % 300);
                return cable_.delay(late, late), "cable late";
            }
            default:
                return cable_.heal(), cable_.delay(0ms, 0ms), "cable mended";
        }
    }
    void join() {
        cable_.heal();
        cable_.delay(0ms, 0ms);
        if (!link_) link_ = std::make_unique<BoneLink>("127.0.0.1", cable_.port());
    }
    bool is_live() const { return last_.status == LinkStatus::live; }
    bool is_finished() const { return last_.status == LinkStatus::finished; }
    bool has(const std::string& served) const {
        return link_->bone() != nullptr && fmt::format("{:016x}", checksum(*link_->bone())) == served;
    }
    std::uint64_t mismatches() const { return last_.checksum_mismatches; }
    const std::string& status_line() const { return last_.status_line; }

  private:
    LinkProxy cable_;
    std::unique_ptr<BoneLink> link_;
    LinkUpdate last_;
};

class Soak {
  public:
    Soak(std::string server, std::string replay, double minutes, unsigned seed)
        : server_program_(std::move(server)), replay_(std::move(replay)), minutes_(minutes), random_(seed) {
        write_block(file("block.nrrd"), 300);
        write_motion(file("motion.csv"), minutes);
    }

    bool run() {
        server_ = std::make_unique<ChildProcess>(std::vector<std::string>{
            server_program_, "--bone", file("block.nrrd"), "--trajectory", file("motion.csv"), "--listen",
            "127.0.0.1:0", "--record", file("session.pcap"), "--metrics", "127.0.0.1:0", "--json",
            file("server.json")});
        const auto metrics = server_->line_after("metrics on 127.0.0.1:");
        const auto address = server_->address();
        if (!metrics || !address) throw std::runtime_error("the server did not begin: " + server_->err());
        const auto port = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1)));
        for (std::size_t i = 0; i < clients; ++i) stations_.push_back(std::make_unique<Station>(port));
        // All clients have joined once: the server's memory for eight of them does not count as growth.
        if (!all_become(&Station::is_live, true)) print_stations("not all came");
        let_them_come_and_go(*metrics);
        print_ticks();
        const bool bones_are_equal = end_and_compare();
        const bool memory_is_steady = judge_memory();
        return bones_are_equal && memory_is_steady && virtual_sessions_are_equal_;
    }

  private:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    nlohmann::json json(const std::string& name) const {
        std::ifstream in(file(name));
        return nlohmann::json::parse(in);
    }

    void let_them_come_and_go(const std::string& metrics_port) {
        const auto began = Clock::now();
        const std::chrono::duration<double> lasts = std::chrono::duration<double, std::ratio<60>>(minutes_);
        auto next_fault = began;
        auto next_sample = began;
        auto next_beside = began;
        std::size_t faults = 0;
        ticks_.push_back(scraped(metrics_port));
        while (Clock::now() < began + lasts) {
            for (const auto& station : stations_) station->poll();
            if (Clock::now() >= next_fault) {
                stations_[random_() % clients]->suffer(random_);
                next_fault += std::chrono::milliseconds(200 + random_() % 1800);
                ++faults;
            }
            if (Clock::now() >= next_sample) {
                memory_mib_.push_back(resident_mib(server_->pid()));
                server_->read_output();
                next_sample += 1s;
            }
            if (Clock::now() >= next_beside) {
                run_beside();
                next_beside += 10s;
            }
            if (Clock::now() >= began + lasts * static_cast<double>(ticks_.size()) / tenths)
                ticks_.push_back(scraped(metrics_port));
            std::this_thread::sleep_for(20ms);
        }
        while (ticks_.size() <= tenths) ticks_.push_back(scraped(metrics_port));
        fmt::print("{} faults of {} clients in {} minutes\n", faults, clients, minutes_);
    }

    void print_ticks() const {
        fmt::print("tenth  ticks  latency mean, us  missed deadlines\n");
        for (std::size_t tenth = 1; tenth <= tenths; ++tenth) {
            const auto during = [&](const char* name) {
                const std::string key = fmt::format("osteomill_{}", name);
                return ticks_[tenth].at(key) - ticks_[tenth - 1].at(key);
            };
            fmt::print("{:5}  {:5.0f}  {:16.1f}  {:16.0f}\n", tenth, during("ticks_total"),
                       1e6 * during("tick_latency_seconds_sum") / during("tick_latency_seconds_count"),
                       during("missed_deadlines_total"));
        }
    }

    /// Ten seconds of the tooth on the virtual clock, unless the last session still runs.
    void run_beside() {
        if (virtual_) {
            const auto status = virtual_->wait(0s);
            if (!status) return;  // it runs
            if (*status != 0) throw std::runtime_error("on the virtual clock: " + virtual_->err());
            const std::string bone = json("virtual.json").at("bone_checksum");
            if (virtual_sessions_++ == 0) virtual_bone_ = bone;
            virtual_sessions_are_equal_ = virtual_sessions_are_equal_ && bone == virtual_bone_;
        }
        virtual_ = std::make_unique<ChildProcess>(
            std::vector<std::string>{server_program_, "--scene", "tooth", "--clock", "virtual",
                                     "--duration-s", "10", "--json", file("virtual.json")});
    }

    /// Waits for all stations, which join first if `they_join`.
    bool all_become(bool (Station::*are)() const, bool they_join) {
        if (they_join)
            for (const auto& station : stations_) station->join();
        return eventually([&] {
            for (const auto& station : stations_) station->poll();
            std::this_thread::sleep_for(20ms);
            return std::ranges::all_of(stations_, [are](const auto& station) { return (*station.*are)(); });
        });
    }

    /// Waits until all have been live for a while: a server that hangs up on who was away too long does it
    /// a moment after the cable is mended, and whoever comes back to a server that ends finds nobody.
    bool all_stay_live() {
        constexpr auto a_while = 3s;
        for (int tries = 0; tries < 5; ++tries) {
            if (!all_become(&Station::is_live, true)) return false;
            bool stayed = true;
            for (const auto began = Clock::now(); stayed && Clock::now() < began + a_while;) {
                std::this_thread::sleep_for(20ms);
                for (const auto& station : stations_) station->poll();
                stayed = std::ranges::all_of(stations_, [](const auto& s) { return s->is_live(); });
            }
            if (stayed) return true;
        }
        return false;
    }

    bool end_and_compare() {
        const bool live = all_stay_live();
        if (!live) print_stations("not all are live");
        server_->send_signal(SIGINT);
        const bool finished = all_become(&Station::is_finished, false);
        if (!finished) print_stations("not all have finished");
        const auto status = server_->wait();
        if (status != 0) throw std::runtime_error("the server failed: " + server_->err());
        const std::string served = json("server.json").at("bone_checksum");
        const auto equal = std::ranges::count_if(stations_, [&](const auto& s) { return s->has(served); });
        std::uint64_t mismatches = 0;
        for (const auto& station : stations_) mismatches += station->mismatches();

        ChildProcess replay({replay_, file("session.pcap"), "--json", file("replay.json")});
        const bool is_whole = replay.wait(600s) == 0;
        const bool recorded = is_whole && json("replay.json").dump().find(served) != std::string::npos;
        fmt::print("bone {}: {} of {} clients have it, {} mismatches on the way; the recording ({} MB) {}\n",
                   served, equal, clients, mismatches,
                   std::filesystem::file_size(file("session.pcap")) / 1000000,
                   recorded ? "has it" : "DIFFERS");
        fmt::print("missed deadlines of the haptic loop: {}\n",
                   json("server.json").at("missed_deadlines").dump());
        fmt::print("{} sessions of 10 s on the virtual clock, {}\n", virtual_sessions_,
                   virtual_sessions_are_equal_ ? "one bone" : "DIFFERENT BONES");
        return live && finished && static_cast<std::size_t>(equal) == clients && recorded;
    }

    void print_stations(const char* why) const {
        for (const auto& station : stations_) fmt::print("{}: {}\n", why, station->status_line());
    }

    bool judge_memory() const {
        const std::size_t tenth = memory_mib_.size() / 10;
        const auto of_tenth = [&](std::size_t n) {
            const auto from = memory_mib_.begin() + static_cast<std::ptrdiff_t>(n * tenth);
            return median({from, from + static_cast<std::ptrdiff_t>(tenth)});
        };
        const double before_mib = of_tenth(1);
        const double after_mib = of_tenth(9);
        const double most_mib =
            minutes_ >= long_run_minutes ? most_growth_share * before_mib : most_growth_mib;
        fmt::print("memory of the server: {:.2f} MiB, {:.2f} MiB at the end, may grow by {:.2f}\n",
                   before_mib, after_mib, most_mib);
        return after_mib - before_mib <= most_mib;
    }

    TemporaryFolder folder_;
    std::string server_program_, replay_;
    double minutes_;
    std::mt19937 random_;
    std::unique_ptr<ChildProcess> server_;
    std::unique_ptr<ChildProcess> virtual_;
    std::vector<std::unique_ptr<Station>> stations_;
    std::vector<double> memory_mib_;
    std::vector<std::map<std::string, double>> ticks_;  ///< the metrics at the beginning and after each tenth
    std::string virtual_bone_;
    int virtual_sessions_ = 0;
    bool virtual_sessions_are_equal_ = true;
};

}  // namespace
}  // namespace osteomill::testing

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fputs("soak HAPTIC_SERVER PACKET_REPLAY MINUTES [SEED]\n", stderr);
        return 2;
    }
    try {
        const unsigned seed = argc > 4 ? static_cast<unsigned>(std::stoul(argv[4])) : 1U;
        return osteomill::testing::Soak(argv[1], argv[2], std::stod(argv[3]), seed).run() ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "soak: {}\n", error.what());
        return 1;
    }
}
