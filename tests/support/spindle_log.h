// When a server's spindle turned, by the server's own session time, and what session time it was when
// something happened outside. So a test of "off within so many milliseconds" asks nothing of the machine that
// it runs on but that the server's own ticks come.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "common/wire/tool_view.h"

namespace osteomill::testing {

/// The session's time by the wall clock of this machine, learnt from the server's state frames.
class SessionClock {
  public:
    void note(const ToolView& tool) {
        if (tool.taken_unix_ns == 0 || tool.time_s <= 0.0) return;
        // A tool is up to a tick old when it is taken, never younger.
        began_s_ = std::min(began_s_, 1e-9 * static_cast<double>(tool.taken_unix_ns) - tool.time_s);
    }
    double now_s() const {
        const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
        return std::chrono::duration<double>(since_1970).count() - began_s_;
    }

  private:
    double began_s_ = std::numeric_limits<double>::infinity();
};

/// A line of the server's --log-csv, as far as this needs it.
struct SpindleSample {
    double time_s = 0.0;
    std::array<double, 3> burr_mm{};
    double removed_mm3 = 0.0;
    bool turns = false;
};

inline std::vector<SpindleSample> read_spindle_log(const std::filesystem::path& csv) {
    std::vector<SpindleSample> samples;
    std::ifstream in(csv);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        std::array<double, 14> value{};
        bool is_whole = true;
        for (double& number : value) is_whole = is_whole && static_cast<bool>(words >> number);
        if (is_whole)
            samples.push_back({value[0], {value[4], value[5], value[6]}, value[11], value[12] != 0.0});
    }
    return samples;
}

/// How long after `event_s` the spindle turned last before it stood still; nothing where it did not turn then
/// or did not stop.
inline std::optional<double> spindle_off_after_s(const std::vector<SpindleSample>& log, double event_s) {
    const auto after = [&](double time_s) {
        return std::ranges::lower_bound(log, time_s, {}, &SpindleSample::time_s);
    };
    const auto at = after(event_s);
    if (at == log.end() || !at->turns) return std::nullopt;
    const auto off = std::find_if(at, log.end(), [](const SpindleSample& sample) { return !sample.turns; });
    if (off == log.end()) return std::nullopt;
    return off->time_s - event_s;
}

}  // namespace osteomill::testing
