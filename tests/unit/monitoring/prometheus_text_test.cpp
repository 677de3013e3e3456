#include "haptic_server/monitoring/prometheus_text.h"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/file_text.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using testing::text_of;

std::set<std::string> named_in(const std::string& text) {
    const std::regex metric("osteomill_[a-z_]+");
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), metric), end; at != end; ++at)
        names.insert(at->str());
    return names;
}

TEST(MetricsText, SaysWhatWasCounted) {
    TickMeter::Reading loop{.session_s = 2.5, .ticks = 7, .missed_deadlines = 3, .latency_sum_s = 0.25};
    loop.latency.front() = 4;
    loop.latency[1] = 2;
    loop.latency.back() = 1;
    loop.faults[static_cast<std::size_t>(Fault::overrun)] = 5;
    loop.fault = Fault::overrun;
    loop.spindle_on = true;
    const std::string text = prometheus_text(loop, {.clients = 2, .sent_bytes = 12'345'678'901}, "9.8.7");
    for (const char* line :
         {"osteomill_session_seconds 2.5\n", "osteomill_ticks_total 7\n",
          "osteomill_missed_deadlines_total 3\n", "osteomill_tick_latency_seconds_bucket{le=\"5e-06\"} 4\n",
          "osteomill_tick_latency_seconds_bucket{le=\"1e-05\"} 6\n",
          "osteomill_tick_latency_seconds_bucket{le=\"0.05\"} 6\n",
          "osteomill_tick_latency_seconds_bucket{le=\"+Inf\"} 7\n",
          "osteomill_tick_latency_seconds_count 7\n", "osteomill_tick_latency_seconds_sum 0.25\n",
          "osteomill_faults_total{fault=\"overrun\"} 5\n",
          "osteomill_faults_total{fault=\"device_lost\"} 0\n", "osteomill_force_off 1\n",
          "osteomill_spindle_on 1\n", "osteomill_clients 2\n", "osteomill_sent_bytes_total 12345678901\n",
          "osteomill_build_info{version=\"9.8.7\"} 1\n"})
        EXPECT_THAT(text, HasSubstr("\n" + std::string(line))) << line;
}

// The grammar of the format: each family is a HELP and a TYPE before its samples, and comes once.
TEST(MetricsText, IsInPrometheusFormat) {
    std::istringstream lines("\n" + prometheus_text({}, {}, "9.8.7"));
    const std::regex help("# HELP (osteomill_[a-z_]+) [^\\\\]+");
    const std::regex type("# TYPE (osteomill_[a-z_]+) (counter|gauge|histogram)");
    const std::regex sample("(osteomill_[a-z_]+)(\\{[a-z]+=\"[^\"\\\\]+\"\\})? [-+0-9.e]+");
    std::set<std::string> families;
    std::string family;
    std::string kind;
    std::smatch found;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        if (std::regex_match(line, found, help)) {
            family = found[1];
            EXPECT_TRUE(families.insert(family).second) << family << " comes twice";
            ASSERT_TRUE(std::getline(lines, line) && std::regex_match(line, found, type)) << line;
            EXPECT_EQ(found[1], family);
            kind = found[2];
            EXPECT_EQ(kind == "counter", family.ends_with("_total")) << family;
            continue;
        }
        ASSERT_TRUE(std::regex_match(line, found, sample)) << line;
        if (kind == "histogram")
            EXPECT_THAT(found[1].str(), ::testing::StartsWith(family + "_"));
        else
            EXPECT_EQ(found[1], family);
    }
    EXPECT_GT(families.size(), 10U);
}

TEST(MetricsText, IsWhatTheDocumentAndTheDashboardName) {
    const std::string text = prometheus_text({}, {}, "9.8.7");
    const std::string document = text_of(REPOSITORY "/docs/operating.md");
    const std::regex family("# TYPE (osteomill_[a-z_]+)");
    for (std::sregex_iterator at(text.begin(), text.end(), family), end; at != end; ++at)
        EXPECT_THAT(document, HasSubstr("`" + (*at)[1].str()));
    const std::set<std::string> there = named_in(text);
    const std::set<std::string> shown = named_in(text_of(REPOSITORY "/docs/grafana_dashboard.json"));
    EXPECT_GT(shown.size(), 5U);
    for (const std::string& name : shown) EXPECT_TRUE(there.contains(name)) << name << " of the dashboard";
}

}  // namespace
}  // namespace osteomill
