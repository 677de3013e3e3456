#include "analysis/report/write_report.h"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "analysis/report/metrics_csv_json.h"
#include "analysis/report/report_html.h"
#include "common/files/atomic_file.h"

namespace osteomill {

std::string write_report(const std::filesystem::path& recording, const std::filesystem::path& folder,
                         const ReportProgress& on_frame) {
    // Most of the work; the marks' pictures take a second reading.
    constexpr double trace_share = 0.7;
    const SessionTrace trace = read_trace(recording, [&](double done) { on_frame(trace_share * done); });
    const SessionMetrics metrics = session_metrics(trace);
    const std::vector<MetricRow> rows = metric_rows(metrics);
    const SessionPictures pictures = session_pictures(
        recording, trace, [&](double done) { on_frame(trace_share + (1.0 - trace_share) * done); });
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
    write_atomic_file(folder / "report.html",
                      report_html(trace, metrics, rows, pictures, reference_sessions(folder, trace)),
                      Link::replace);
    write_atomic_file(folder / "metrics.csv", metrics_csv(rows), Link::replace);
    write_atomic_file(folder / "metrics.json", metrics_json(trace, rows, metrics.rating), Link::replace);
    on_frame(1.0);
    return trace.error;
}

}  // namespace osteomill
