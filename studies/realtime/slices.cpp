#include "studies/realtime/slices.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "render_client/link/bone_link.h"
#include "simulation/loop/thread_priority.h"
#include "tests/support/child_process.h"

namespace osteomill::study {

namespace {

/// Beyond the duration: to load, to join threads, to write.
constexpr std::chrono::seconds room{60};

nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file.string() + ": is not there");
    try {
        return nlohmann::json::parse(in);
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(file.string() + ": " + error.what());
    }
}

[[noreturn]] void fail(const std::string& program, const osteomill::testing::ChildProcess& child) {
    const std::string said = child.err().empty() ? child.out() : child.err();
    throw std::runtime_error(program + " failed: " + said.substr(0, said.find('\n')));
}

std::uint16_t port_of(const std::string& address) {
    std::uint16_t port = 0;
    const std::size_t colon = address.rfind(':') + 1;
    std::from_chars(address.data() + colon, address.data() + address.size(), port);
    return port;
}

}  // namespace

void Served::add(const Served& other) {
    wakeup.add(other.wakeup);
    haptic_tick.add(other.haptic_tick);
    milling_step.add(other.milling_step);
    ticks += other.ticks;
    late_ticks += other.late_ticks;
    missed_deadlines += other.missed_deadlines;
    missed_milling_steps += other.missed_milling_steps;
    page_faults += other.page_faults;
    overruns += other.overruns;
    client_frames += other.client_frames;
    removed_mm3 += other.removed_mm3;
    has_priority = has_priority && other.has_priority;
    has_locked_memory = has_locked_memory && other.has_locked_memory;
}

Served serve(const std::filesystem::path& haptic_server, double duration_s,
             const std::filesystem::path& work) {
    const std::filesystem::path file = work / "server.json";
    const std::filesystem::path histograms_file = work / "server.histograms.json";
    osteomill::testing::ChildProcess server({haptic_server.string(), "--listen", "127.0.0.1:0",
                                             "--milling-rate-hz", "1000", "--duration-s",
                                             fmt::format("{}", duration_s), "--record",
                                             (work / "session.pcap").string(), "--json", file.string()});
    const auto address = server.line_after("listening on ", room);
    if (!address) fail("haptic_server", server);

    std::uint64_t client_frames = 0;
    std::optional<int> status;
    {
        BoneLink first("127.0.0.1", port_of(*address));
        BoneLink second("127.0.0.1", port_of(*address));
        const auto give_up = std::chrono::steady_clock::now() + room +
                             std::chrono::seconds(static_cast<long>(std::ceil(duration_s)));
        while (!status && std::chrono::steady_clock::now() < give_up) {
            status = server.wait(std::chrono::seconds(0));  // looks for 50 ms
            client_frames = first.poll().frames + second.poll().frames;
        }
    }
    if (status != 0) fail("haptic_server", server);
    if (client_frames == 0) throw std::runtime_error("haptic_server: no client has seen the session");

    const nlohmann::json json = read_json(file);
    const nlohmann::json histograms = read_json(histograms_file);
    const auto& page_faults = json.at("page_faults");
    return {.wakeup = latencies_of_server(histograms.at("wakeup_latency")),
            .haptic_tick = latencies_of_server(histograms.at("haptic_tick")),
            .milling_step = latencies_of_server(histograms.at("milling_step")),
            .ticks = json.at("ticks"),
            .late_ticks = json.at("late_ticks"),
            .missed_deadlines = json.at("missed_deadlines"),
            .missed_milling_steps = json.at("missed_milling_steps"),
            .page_faults = page_faults.at("haptic").get<std::uint64_t>() +
                           page_faults.at("milling").get<std::uint64_t>(),
            .overruns = json.at("faults").at("overrun"),
            .client_frames = client_frames,
            .removed_mm3 = json.at("removed_mm3").at("total"),
            .has_priority = json.at("real_time_priority"),
            .has_locked_memory = json.at("memory_locked")};
}

Latencies cycle(const std::filesystem::path& cyclictest, double duration_s, bool has_priority,
                const std::filesystem::path& work) {
    const std::filesystem::path file = work / "cyclictest.json";
    constexpr int longest_us = 20'000;
    std::vector<std::string> command{cyclictest.string(),
                                     "--quiet",
                                     "--mlockall",
                                     "--default-system",
                                     "--threads=1",
                                     "--interval=1000",
                                     fmt::format("--histogram={}", longest_us),
                                     "--histfile=/dev/null",
                                     fmt::format("--duration={:.0f}", std::ceil(duration_s)),
                                     "--json=" + file.string()};
    command.emplace_back(has_priority ? "--policy=fifo" : "--policy=other");
    if (has_priority) command.push_back(fmt::format("--priority={}", haptic_priority));
    osteomill::testing::ChildProcess child(command);
    const auto status = child.wait(room + std::chrono::seconds(static_cast<long>(std::ceil(duration_s))));
    if (status != 0) fail("cyclictest", child);
    return latencies_of_cyclictest(read_json(file));
}

}  // namespace osteomill::study
