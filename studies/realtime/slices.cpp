#include "studies/realtime/slices.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/files/input_file.h"
#include "common/net/listen_address.h"
#include "common/program/child_program.h"
#include "common/text/foreign_json.h"
#include "common/text/words.h"
#include "render_client/link/bone_link.h"
#include "simulation/loop/thread_priority.h"

namespace osteomill::study {

namespace {

/// Beyond the duration: to load, to join threads, to write.
constexpr std::chrono::seconds room{60};
constexpr std::chrono::milliseconds between_looks{20};

nlohmann::json read_json(const std::filesystem::path& file) {
    try {
        return parse_foreign_json(read_text(file, json_kind), file.string());
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(file.string() + ": " + error.what());
    }
}

[[noreturn]] void fail(const std::string& name, const ChildProgram& program) {
    throw std::runtime_error(name + " failed: " + program.last_line());
}

/// Reads what a program says until `is_done` or its end; false where that takes longer.
template <typename IsDone>
bool watch(ChildProgram& program, std::chrono::duration<double> longest, IsDone&& is_done) {
    const auto give_up = std::chrono::steady_clock::now() + longest;
    while (std::chrono::steady_clock::now() < give_up) {
        program.poll();
        if (is_done() || !program.is_running()) return true;
        std::this_thread::sleep_for(between_looks);
    }
    return false;
}

/// Of "listening on 127.0.0.1:PORT", once all of that line is there.
std::optional<std::uint16_t> port_said_in(const std::string& output) {
    const std::size_t said = output.find("listening on ");
    const std::size_t end = said == std::string::npos ? said : output.find('\n', said);
    if (end == std::string::npos) return std::nullopt;
    return parse_number<std::uint16_t>(parts_of_address(output.substr(said, end - said)).port);
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
    ChildProgram server({haptic_server.string(), "--listen", "127.0.0.1:0", "--milling-rate-hz", "1000",
                         "--duration-s", fmt::format("{}", duration_s), "--record",
                         (work / "session.pcap").string(), "--json", file.string()});
    std::optional<std::uint16_t> port;
    watch(server, room, [&] { return (port = port_said_in(server.output())).has_value(); });
    if (!port) fail("haptic_server", server);

    std::uint64_t client_frames = 0;
    {
        BoneLink first("127.0.0.1", *port);
        BoneLink second("127.0.0.1", *port);
        watch(server, room + std::chrono::duration<double>(duration_s), [&] {
            client_frames = first.poll().frames + second.poll().frames;
            return false;
        });
    }
    if (server.status() != 0) fail("haptic_server", server);
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
    ChildProgram child(command);
    watch(child, room + std::chrono::duration<double>(duration_s), [] { return false; });
    if (child.status() != 0) fail("cyclictest", child);
    return latencies_of_cyclictest(read_json(file));
}

}  // namespace osteomill::study
