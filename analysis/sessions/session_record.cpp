#include "analysis/sessions/session_record.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "analysis/report/session_metrics.h"
#include "common/files/input_file.h"
#include "common/text/plain_text.h"
#include "imaging/bone_file/digest.h"

namespace osteomill::study {

std::optional<double> SessionRecord::value(const std::string& key) const {
    const auto found =
        std::ranges::find_if(metrics, [&](const KeptMetric& m) { return m.key == key && m.of.empty(); });
    return found == metrics.end() ? std::nullopt : found->value;
}

std::optional<double> SessionRecord::sum(const std::string& key) const {
    std::optional<double> sum;
    for (const KeptMetric& metric : metrics)
        if (metric.key == key && metric.value) sum = sum.value_or(0.0) + *metric.value;
    return sum;
}

std::string digest_of_file(const std::filesystem::path& file) {
    const InputFile in(file, {.what = "a recording"});
    Digest digest;
    std::array<std::byte, 1 << 16> bytes{};
    for (std::uint64_t done = 0; done < in.size();) {
        const std::size_t read = in.read_at(done, bytes);
        if (read == 0) break;
        digest.add(std::span(bytes).first(read));
        done += read;
    }
    return digest.text();
}

SessionRecord record_of(const std::filesystem::path& file, const std::string& digest) {
    const SessionTrace trace = read_trace(file, [](double) {});
    if (!trace.error.empty()) throw std::runtime_error(trace.error);
    if (!trace.ends) throw std::runtime_error(file.string() + ": is torn: the session's end is missing");
    const SessionInfo& session = trace.session;
    SessionRecord record{.digest = digest,
                         .file = printable(file.string()),
                         .trainee = session.trainee.empty() ? "(no name)" : session.trainee,
                         .case_name = session.case_name.empty() ? session.scene_name : session.case_name,
                         .began_unix_ns = trace.began_unix_ns};
    for (const MetricRow& row : metric_rows(session_metrics(trace)))
        record.metrics.push_back({row.key, row.of, row.value, row.unit, row.text});
    return record;
}

}  // namespace osteomill::study
