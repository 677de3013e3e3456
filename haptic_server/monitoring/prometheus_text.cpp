#include "haptic_server/monitoring/prometheus_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/text/append.h"
#include "simulation/loop/milling_session.h"
#include "simulation/safety/fault.h"

namespace osteomill {

void TickMeter::push(const TickSample& tick, std::chrono::steady_clock::time_point done) noexcept {
    if (now_.ticks > 0) {
        const double periods = std::round((tick.time_s - now_.session_s) / MillingSession::tick_s);
        if (periods > 1.0) now_.missed_deadlines += static_cast<std::uint64_t>(periods) - 1;
    }
    now_.session_s = tick.time_s;
    ++now_.ticks;

    if (began_) {
        const double latency_s = std::chrono::duration<double>(done - *began_).count() - tick.time_s;
        const auto bound = std::lower_bound(latency_bounds_s.begin(), latency_bounds_s.end(), latency_s);
        ++now_.latency[static_cast<std::size_t>(bound - latency_bounds_s.begin())];
        now_.latency_sum_s += latency_s;
    }

    if (static_cast<Fault>(tick.fault) != now_.fault && tick.fault < now_.faults.size())
        ++now_.faults[tick.fault];
    now_.fault = static_cast<Fault>(tick.fault);
    if (tick.spindle_on && !now_.spindle_on) ++now_.spindle_starts;
    now_.spindle_on = tick.spindle_on;
    now_.force_n = glm::length(tick.force_n);
    now_.removed_mm3 = tick.removed_mm3;
    readings_.back() = now_;
    readings_.publish();
}

namespace {

class Page {
  public:
    void head(const char* name, const char* type, const char* help) {
        append_formatted(text_, "# HELP osteomill_{0} {2}\n# TYPE osteomill_{0} {1}\n", name, type, help);
    }
    template <typename Value>
    void value(const std::string& name, const Value& value) {
        append_formatted(text_, "osteomill_{} {}\n", name, value);
    }
    template <typename Value>
    void only(const char* name, const char* type, const char* help, const Value& only_value) {
        head(name, type, help);
        value(name, only_value);
    }
    std::string text() && { return std::move(text_); }

  private:
    std::string text_;
};

}  // namespace

std::string prometheus_text(const TickMeter::Reading& loop, const StreamingTraffic& traffic,
                            const std::string& version) {
    Page page;
    page.only("session_seconds", "gauge", "Session time.", loop.session_s);
    page.only("ticks_total", "counter", "Ticks of the haptic loop.", loop.ticks);
    page.only("missed_deadlines_total", "counter", "Milliseconds that no tick of the haptic loop came for.",
              loop.missed_deadlines);

    page.head("tick_latency_seconds", "histogram",
              "From when a tick of the haptic loop was due to when its work was done.");
    std::uint64_t up_to = 0;
    for (std::size_t i = 0; i < TickMeter::latency_bounds_s.size(); ++i)
        page.value(fmt::format("tick_latency_seconds_bucket{{le=\"{}\"}}", TickMeter::latency_bounds_s[i]),
                   up_to += loop.latency[i]);
    up_to += loop.latency.back();
    page.value("tick_latency_seconds_bucket{le=\"+Inf\"}", up_to);
    page.value("tick_latency_seconds_sum", loop.latency_sum_s);
    page.value("tick_latency_seconds_count", up_to);

    page.head("faults_total", "counter", "How often the force went off, by cause.");
    for (const Fault fault : all_faults)
        page.value(fmt::format("faults_total{{fault=\"{}\"}}", name_of(fault)),
                   loop.faults[static_cast<std::size_t>(fault)]);
    page.only("force_off", "gauge", "1 while the force is off.", loop.fault == Fault::none ? 0 : 1);
    page.only("force_newtons", "gauge", "Size of the force on the hand.", loop.force_n);
    page.only("removed_cubic_millimetres", "gauge", "Bone removed, by earlier sessions of a saved bone, too.",
              loop.removed_mm3);
    page.only("spindle_on", "gauge", "1 while the spindle turns.", loop.spindle_on ? 1 : 0);
    page.only("spindle_starts_total", "counter", "How often the spindle was started.", loop.spindle_starts);

    page.only("clients", "gauge", "Clients that are connected.", traffic.clients);
    page.only("sent_bytes_total", "counter", "Bytes of frames sent to clients.", traffic.sent_bytes);
    page.head("build_info", "gauge", "1, with the server's version.");
    page.value(fmt::format("build_info{{version=\"{}\"}}", version), 1);
    return std::move(page).text();
}

}  // namespace osteomill
