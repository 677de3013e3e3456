// How long a spindle runs on when its operator's permission has ended: a real server, a client that holds the
// pedal down, and what happens to one of them. Times are the server's own session times, a line a millisecond
// of its --log-csv; a run in which the spindle did not stop within ten seconds says so. Prints; asserts
// nothing.
//
//     spindle_off_benchmark HAPTIC_SERVER [RUNS [FAULT...]]
//
// cut: the operator's program is killed, and its connection with it. frozen: it is stopped (SIGSTOP).
// delayed: from now on what it sends takes 5 s, and the pedal comes up. terminal-frozen: nobody reads the
// server's output any more, and the operator's connection closes. log-full: the server's standard error is
// /dev/full, and the operator's connection closes.
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "render_client/link/bone_link.h"
#include "tests/support/child_process.h"
#include "tests/support/link_proxy.h"
#include "tests/support/spindle_log.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds driven_before_fault = 700ms;
constexpr std::chrono::seconds longest_run_on{10};

/// An operator who does not move.
void drive(BoneLink& link, bool pedal) {
    link.poll();
    if (const auto tool = link.newest_tool())
        link.send_operator({.hand_target_mm = tool->hand_position_mm, .pedal = pedal});
}

/// The operator's program: this one, called again. Until it is killed.
[[noreturn]] void drive_for_ever(std::uint16_t port) {
    for (BoneLink link("127.0.0.1", port);; std::this_thread::sleep_for(10ms)) drive(link, true);
}

/// Where the server's output goes.
class Terminal {
  public:
    explicit Terminal(const std::filesystem::path& fifo) : fifo_(fifo) {
        if (::mkfifo(fifo.c_str(), 0600) != 0) throw std::runtime_error("no FIFO at " + fifo.string());
        end_ = ::open(fifo.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (end_ < 0) throw std::runtime_error("cannot open " + fifo.string());
        reader_ = std::thread([this] { read(); });
    }
    ~Terminal() {
        is_over_ = true;
        reader_.join();
        ::close(end_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// Nobody reads any more, and nothing more fits.
    void freeze() {
        is_frozen_ = true;
        std::this_thread::sleep_for(50ms);  // the reader has seen it
        const std::array<char, 1> byte{'.'};
        while (::write(end_, byte.data(), 1) == 1) {
        }
    }
    void thaw() { is_frozen_ = false; }
    /// The rest of the first line that begins so; nothing where none comes in time.
    std::optional<std::string> line_after(const std::string& prefix, std::chrono::seconds deadline) {
        for (const auto end = Clock::now() + deadline; Clock::now() < end; std::this_thread::sleep_for(5ms)) {
            const std::scoped_lock lock(mutex_);
            const auto at = text_.find(prefix);
            const auto line_end = at != std::string::npos ? text_.find('\n', at) : at;
            if (line_end != std::string::npos)
                return text_.substr(at + prefix.size(), line_end - at - prefix.size());
        }
        return std::nullopt;
    }
    const std::filesystem::path& fifo() const { return fifo_; }

  private:
    void read() {
        std::array<char, 4096> bytes;
        while (!is_over_) {
            const auto count = is_frozen_ ? 0 : ::read(end_, bytes.data(), bytes.size());
            if (count <= 0) {
                std::this_thread::sleep_for(5ms);
                continue;
            }
            const std::scoped_lock lock(mutex_);
            text_.append(bytes.data(), static_cast<std::size_t>(count));
        }
    }

    std::filesystem::path fifo_;
    int end_ = -1;
    std::atomic<bool> is_frozen_{false};
    std::atomic<bool> is_over_{false};
    std::mutex mutex_;
    std::string text_;
    std::thread reader_;
};

struct Programs {
    std::string server;
    std::string self;
};

/// One session, until its fault.
struct Session {
    Session(const Programs& programs, Terminal& terminal, bool has_full_log)
        : server({"/bin/sh", "-c", R"(out=$0; err=$1; shift; exec "$@" >"$out" 2>"$err")",
                  terminal.fifo().string(), has_full_log ? "/dev/full" : terminal.fifo().string(),
                  programs.server, "--scene", "cube", "--device", "client", "--listen", "127.0.0.1:0",
                  "--log-csv", csv.string()}) {
        const auto address = terminal.line_after("listening on ", 60s);
        if (!address) throw std::runtime_error("the server did not start");
        port = static_cast<std::uint16_t>(std::stoi(address->substr(address->rfind(':') + 1)));
        watching = std::make_unique<BoneLink>("127.0.0.1", port);
    }
    /// Looks on for so long, or until the spindle does so.
    bool watch(std::chrono::milliseconds time, std::optional<bool> until_spindle = std::nullopt) {
        for (const auto end = Clock::now() + time; Clock::now() < end; std::this_thread::sleep_for(5ms)) {
            const auto tool = watching->poll().tool;
            if (!tool) continue;
            clock.note(*tool);
            if (until_spindle && tool->spindle_on == *until_spindle) return true;
        }
        return false;
    }

    TemporaryFolder folder;
    std::filesystem::path csv = folder / "log.csv";
    ChildProcess server;
    std::uint16_t port = 0;
    std::unique_ptr<BoneLink> watching;
    SessionClock clock;
};

struct Fault {
    std::string name;
    /// Makes it happen to a session whose spindle turns; the session time when it did.
    std::function<double(Session&, ChildProcess& driver, LinkProxy&, std::atomic<bool>& pedal, Terminal&)>
        happen;
    bool is_driven_from_here = false;
    bool has_full_log = false;
};

double kill_driver(Session& session, ChildProcess& driver) {
    const double at_s = session.clock.now_s();
    driver.send_signal(SIGKILL);
    return at_s;
}

std::vector<Fault> faults() {
    return {
        {.name = "cut",
         .happen = [](Session& session, ChildProcess& driver, LinkProxy&, std::atomic<bool>&,
                      Terminal&) { return kill_driver(session, driver); }},
        {.name = "frozen",
         .happen =
             [](Session& session, ChildProcess& driver, LinkProxy&, std::atomic<bool>&, Terminal&) {
                 const double at_s = session.clock.now_s();
                 driver.send_signal(SIGSTOP);
                 return at_s;
             }},
        {.name = "delayed",
         .happen =
             [](Session& session, ChildProcess&, LinkProxy& link, std::atomic<bool>& pedal, Terminal&) {
                 const double at_s = session.clock.now_s();
                 link.delay(5s, 0ms);
                 pedal = false;
                 return at_s;
             },
         .is_driven_from_here = true},
        {.name = "terminal-frozen",
         .happen =
             [](Session& session, ChildProcess& driver, LinkProxy&, std::atomic<bool>&, Terminal& terminal) {
                 terminal.freeze();
                 return kill_driver(session, driver);
             }},
        {.name = "log-full",
         .happen = [](Session& session, ChildProcess& driver, LinkProxy&, std::atomic<bool>&,
                      Terminal&) { return kill_driver(session, driver); },
         .has_full_log = true},
    };
}

/// In ms; nothing where it did not stop, or the server did.
std::optional<double> off_after_ms(const Fault& fault, const Programs& programs) {
    const TemporaryFolder folder;
    Terminal terminal(folder / "terminal");
    Session session(programs, terminal, fault.has_full_log);
    LinkProxy link(session.port);
    std::atomic<bool> pedal{true}, is_over{false};
    std::optional<ChildProcess> driver;
    std::thread driving;
    if (fault.is_driven_from_here)
        driving = std::thread([&] {
            for (BoneLink operators("127.0.0.1", link.port()); !is_over; std::this_thread::sleep_for(10ms))
                drive(operators, pedal);
        });
    else
        driver.emplace(std::vector<std::string>{programs.self, "--drive", std::to_string(link.port())});
    ChildProcess nobody({"/bin/true"});

    std::optional<double> fault_s;
    if (session.watch(30s, true)) {
        session.watch(driven_before_fault);
        fault_s = fault.happen(session, driver ? *driver : nobody, link, pedal, terminal);
        session.watch(longest_run_on, false);
        session.watch(100ms);
    }
    is_over = true;
    if (driving.joinable()) driving.join();
    terminal.thaw();
    session.server.send_signal(SIGINT);
    session.server.wait(60s);
    if (!fault_s) return std::nullopt;
    const auto off_s = spindle_off_after_s(read_force_log(session.csv), *fault_s);
    return off_s ? std::optional(1e3 * *off_s) : std::nullopt;
}

void run(const Programs& programs, int runs, const std::vector<std::string>& wanted) {
    constexpr double run_s = 2.0;  // most of it waits for the spindle to turn, and then to stand
    const auto kinds = std::ranges::count_if(faults(), [&](const Fault& fault) {
        return wanted.empty() || std::ranges::find(wanted, fault.name) != wanted.end();
    });
    fmt::print("takes about {:.0f} min\n", std::ceil(run_s * static_cast<double>(kinds * runs) / 60.0));
    std::fflush(stdout);
    fmt::print("{:<18}{:>6}{:>12}{:>11}   ms of each run\n", "spindle off after", "runs", "median ms",
               "worst ms");
    for (const Fault& fault : faults()) {
        if (!wanted.empty() && std::ranges::find(wanted, fault.name) == wanted.end()) continue;
        std::vector<double> off_ms;
        int endless = 0;
        for (int i = 0; i < runs; ++i) {
            const auto ms = off_after_ms(fault, programs);
            ms ? off_ms.push_back(*ms) : void(++endless);
        }
        std::ranges::sort(off_ms);
        if (off_ms.empty())
            fmt::print("{:<18}{:>6}", fault.name, runs);
        else
            fmt::print("{:<18}{:>6}{:>12.0f}{:>11.0f}   {:.0f}", fault.name, runs, off_ms[off_ms.size() / 2],
                       off_ms.back(), fmt::join(off_ms, " "));
        if (endless > 0) fmt::print("   in {} it did not stop, or the server ended", endless);
        fmt::print("\n");
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace osteomill::testing

int main(int count, char** words) {
    const std::vector<std::string> arguments(words + 1, words + count);
    if (arguments.size() == 2 && arguments[0] == "--drive")
        osteomill::testing::drive_for_ever(static_cast<std::uint16_t>(std::stoi(arguments[1])));
    if (arguments.empty()) {
        fmt::print(stderr, "usage: spindle_off_benchmark HAPTIC_SERVER [RUNS [FAULT...]]\n");
        return 2;
    }
    try {
        osteomill::testing::run(
            {.server = arguments[0], .self = std::filesystem::read_symlink("/proc/self/exe").string()},
            arguments.size() > 1 ? std::stoi(arguments[1]) : 10,
            {arguments.begin() + std::min<long>(2, static_cast<long>(arguments.size())), arguments.end()});
    } catch (const std::exception& error) {
        fmt::print(stderr, "spindle_off_benchmark: {}\n", error.what());
        return 1;
    }
    return 0;
}
