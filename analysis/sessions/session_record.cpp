#include "analysis/sessions/session_record.h"

#include <array>
#include <stdexcept>

#include "common/files/input_file.h"
#include "common/text/plain_text.h"
#include "imaging/bone_file/digest.h"

namespace osteomill::study {

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
    return {.digest = digest,
            .file = printable(file.string()),
            .trainee = session.trainee.empty() ? "(no name)" : session.trainee,
            .case_name = session.case_name.empty() ? session.scene_name : session.case_name,
            .began_unix_ns = trace.began_unix_ns,
            .metrics = metric_rows(session_metrics(trace))};
}

}  // namespace osteomill::study
