#include "haptic_server/check/machine_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <future>
#include <iterator>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "common/statistics/percentile.h"
#include "common/text/words.h"
#include "devices/hid/device_list.h"
#include "devices/hid/hid_transport.h"
#include "simulation/loop/real_time.h"

namespace osteomill {

std::string text_of(const std::vector<CheckRow>& rows) {
    std::string text;
    std::size_t wrong = 0;
    std::size_t waiting = 0;
    for (const CheckRow& row : rows) {
        const char* const verdict = row.is_right() ? "right" : row.can_wait ? "could be better" : "wrong";
        text += fmt::format("{:<16} {:<22} {}\n", verdict, row.what, row.found);
        if (row.is_right()) continue;
        ++(row.can_wait ? waiting : wrong);
        text += fmt::format("{:<16} costs: {}\n{:<16} mend:  {}\n", "", row.cost, "", row.mend);
    }
    return text + fmt::format("{} looked at, {} wrong, {} could be better\n", rows.size(), wrong, waiting);
}

bool must_be_mended(const std::vector<CheckRow>& rows) {
    return std::ranges::any_of(rows, [](const CheckRow& row) { return !row.is_right() && !row.can_wait; });
}

namespace {

/// A thousandth of a tick's period; the loop's own spin before its deadline hides far more.
constexpr double dear_clock_ns = 1000.0;
constexpr double tick_us = 1000.0;
/// A state that takes longer to leave is felt in the latest wake-ups.
constexpr double deep_idle_us = 100.0;

/// Without its last line's end; nullopt if there is no such file.
std::optional<std::string> said_by(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) return std::nullopt;
    return trimmed(std::string(std::istreambuf_iterator<char>(in), {}));
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder, const std::string& prefix) {
    std::vector<std::filesystem::path> found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
}

CheckRow priority_row(const CheckedMachine& machine) {
    if (machine.rights.priority) return {"real-time priority", "allowed"};
    return {"real-time priority", "not allowed",
            "on a busy machine ticks come late by milliseconds, and the force fades out when they do",
            "sudo setcap cap_sys_nice,cap_ipc_lock+ep " + machine.program};
}

std::optional<CheckRow> share_row(const CheckedMachine& machine) {
    const auto runtime_us = said_by(machine.root / "proc/sys/kernel/sched_rt_runtime_us");
    if (!runtime_us) return std::nullopt;
    if (*runtime_us != "0") return CheckRow{"real-time share", *runtime_us + " us of a second"};
    return CheckRow{"real-time share", "none",
                    "the kernel gives a thread of real-time priority no time at all",
                    "sudo sysctl -w kernel.sched_rt_runtime_us=950000"};
}

CheckRow locking_row(const CheckedMachine& machine) {
    if (machine.rights.memory) return {"page locking", "allowed"};
    return {"page locking", "not allowed",
            "a tick may wait for a page from the disk: milliseconds, now and then",
            "sudo setcap cap_sys_nice,cap_ipc_lock+ep " + machine.program};
}

CheckRow wake_up_row(const CheckedMachine& machine) {
    const WakeUps wakes = machine.measure_wake_ups();
    CheckRow row{"wake-ups", fmt::format("of {} 99 % within {:.0f} us, the latest after {:.0f} us",
                                         wakes.count, wakes.p99_us, wakes.latest_us)};
    row.can_wait = true;
    if (wakes.latest_us < tick_us) return row;
    row.cost =
        fmt::format("a tick that is {:.1f} ms late is felt as a gap in the force", 1e-3 * wakes.latest_us);
    row.mend =
        "end what else runs here, or keep processors free (isolcpus=2,3) and say --haptic-cpu 2 "
        "--milling-cpu 3";
    return row;
}

std::optional<CheckRow> preemption_row(const CheckedMachine& machine) {
    if (said_by(machine.root / "sys/kernel/realtime") == "1")
        return CheckRow{"kernel preemption", "full, for real time"};
    const auto version = said_by(machine.root / "proc/version");
    if (!version) return std::nullopt;
    for (const char* kind : {"PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"})
        if (version->find(kind) != std::string::npos) return CheckRow{"kernel preemption", kind};
    return CheckRow{"kernel preemption", "none",
                    "the kernel finishes what it is at before a tick runs: up to some milliseconds",
                    "sudo apt-get install linux-image-rt-amd64, and start that kernel"};
}

std::optional<CheckRow> governor_row(const CheckedMachine& machine) {
    std::set<std::string> governors;
    for (const auto& cpu : files_in(machine.root / "sys/devices/system/cpu", "cpu"))
        if (const auto governor = said_by(cpu / "cpufreq/scaling_governor")) governors.insert(*governor);
    if (governors.empty()) return std::nullopt;
    CheckRow row{"frequency", fmt::format("{}", fmt::join(governors, ", "))};
    row.can_wait = true;
    if (governors == std::set<std::string>{"performance"}) return row;
    row.cost = "a processor that has slowed down takes up to twice as long for a tick until it speeds up";
    row.mend = "sudo cpupower frequency-set --governor performance";
    return row;
}

std::optional<CheckRow> idle_row(const CheckedMachine& machine) {
    double latency_us = 0.0;
    std::string deepest;
    const auto states = files_in(machine.root / "sys/devices/system/cpu/cpu0/cpuidle", "state");
    for (const auto& state : states) {
        if (said_by(state / "disable").value_or("0") != "0") continue;
        const double own_us = parse_number<double>(said_by(state / "latency").value_or("0")).value_or(0.0);
        if (own_us < latency_us) continue;
        latency_us = own_us;
        deepest = said_by(state / "name").value_or("");
    }
    if (states.empty() || deepest.empty()) return std::nullopt;
    CheckRow row{"idle states", fmt::format("down to {}, {:.0f} us to leave", deepest, latency_us)};
    row.can_wait = true;
    if (latency_us <= deep_idle_us) return row;
    row.cost = fmt::format("a tick that finds its processor asleep begins {:.0f} us later", latency_us);
    row.mend = fmt::format("sudo cpupower idle-set --disable-by-latency {:.0f}", deep_idle_us);
    return row;
}

std::optional<CheckRow> clock_row(const CheckedMachine& machine) {
    const auto source =
        said_by(machine.root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
    if (!source) return std::nullopt;
    const double read_ns = machine.measure_clock_ns();
    CheckRow row{"clock source", fmt::format("{}, {:.0f} ns to read", *source, read_ns)};
    if (read_ns < dear_clock_ns) return row;
    row.cost =
        fmt::format("each look at the clock takes {:.1f} us, and a tick looks several times", 1e-3 * read_ns);
    row.mend = "start the kernel with clocksource=tsc tsc=reliable, where the processor has a steady counter";
    return row;
}

CheckRow gpu_row(const CheckedMachine& machine) {
    const auto nodes = files_in(machine.root / "dev/dri", "renderD");
    if (!nodes.empty() || std::filesystem::exists(machine.root / "dev/nvidia0"))
        return {"GPU", nodes.empty() ? "NVIDIA" : nodes.front().filename().string()};
    return {"GPU", "none",
            "a window on this machine is drawn by its processors, which the loops then share: 10 to 30 "
            "pictures a second",
            "run render_client on another machine: docs/network.md", true};
}

}  // namespace

std::vector<CheckRow> check_machine(const CheckedMachine& machine) {
    std::vector<CheckRow> rows;
    const auto add = [&](std::optional<CheckRow> row) {
        if (row) rows.push_back(*std::move(row));
    };
    add(priority_row(machine));
    add(share_row(machine));
    add(locking_row(machine));
    add(wake_up_row(machine));
    add(preemption_row(machine));
    add(governor_row(machine));
    add(idle_row(machine));
    add(clock_row(machine));
    add(gpu_row(machine));
    return rows;
}

CheckRow check_devices(HidTransport& transport) {
    const HidReadiness found = readiness_of_devices(transport);
    if (found.closed.empty())
        return {"arms and 3D mice",
                found.ready.empty() ? "none is plugged in" : fmt::format("{}", fmt::join(found.ready, ", "))};
    return {
        "arms and 3D mice", fmt::format("{}", fmt::join(found.closed, "; ")),
        "--device hid or spacemouse ends at once",
        fmt::format("sudo cp {} /etc/udev/rules.d/ && sudo udevadm control --reload && sudo udevadm trigger",
                    udev_rule)};
}

namespace {

using SteadyClock = std::chrono::steady_clock;

WakeUps wake_ups() {
    static constexpr int count = 500;
    static constexpr std::chrono::milliseconds period{1};
    std::vector<double> late_us;
    late_us.reserve(count);
    std::jthread([&late_us] {
        (void)ask_for_real_time(haptic_priority);
        SteadyClock::time_point due = SteadyClock::now();
        for (int i = 0; i < count; ++i) {
            due += period;
            std::this_thread::sleep_until(due);
            late_us.push_back(std::chrono::duration<double, std::micro>(SteadyClock::now() - due).count());
        }
    }).join();
    return {count, percentile(late_us, 0.99), *std::ranges::max_element(late_us)};
}

double clock_ns() {
    constexpr int reads = 10'000;
    const SteadyClock::time_point begin = SteadyClock::now();
    SteadyClock::time_point last;
    for (int i = 0; i < reads; ++i) last = SteadyClock::now();
    return std::chrono::duration<double, std::nano>(last - begin).count() / reads;
}

}  // namespace

CheckedMachine this_machine() {
    return {.program = std::filesystem::read_symlink("/proc/self/exe").string(),
            .rights = real_time_rights(),
            .measure_wake_ups = wake_ups,
            .measure_clock_ns = clock_ns};
}

}  // namespace osteomill
