#include "analysis/sessions/sessions_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <stdexcept>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "analysis/report/trainee_groups.h"
#include "analysis/sessions/department_database.h"
#include "analysis/sessions/overview.h"
#include "analysis/sessions/session_store.h"
#include "common/recording/packet_reader.h"
#include "common/text/plain_text.h"

namespace osteomill::study {

namespace {

std::vector<std::filesystem::path> recordings_of_folder(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_directory() && std::filesystem::is_regular_file(entry.path() / "session.pcap"))
            found.push_back(entry.path() / "session.pcap");
        if (entry.is_regular_file() && entry.path().extension() == ".pcap") found.push_back(entry.path());
    }
    if (found.empty())
        throw std::runtime_error(folder.string() +
                                 ": holds no recording (*.pcap), and no folder that holds a session.pcap");
    return found;
}

struct Recording {
    std::filesystem::path file;
    std::string digest;
    std::optional<SessionRecord> kept;  ///< of an earlier study
};

struct Read {
    SessionRecord record{};
    std::string why_not{};  ///< it cannot be read
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Read, record, why_not)

Read read(const Recording& recording) {
    try {
        return {recording.kept ? *recording.kept : record_of(recording.file, recording.digest), ""};
    } catch (const std::runtime_error& error) {
        return {{}, error.what()};
    }
}

/// As an address in a page that lies in `out`; empty where there is no report beside the recording.
std::string report_address(const std::filesystem::path& recording, const std::filesystem::path& out) {
    const auto report = recording.parent_path() / "report.html";
    if (!std::filesystem::is_regular_file(report)) return {};
    std::string address;
    for (const char letter : std::filesystem::proximate(report, out).generic_string()) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                              std::string_view("/._-~").find(letter) != std::string_view::npos;
        address +=
            is_plain ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    }
    return address;
}

std::map<std::string, std::string> groups_of(const SessionsStudyOptions& options) {
    const auto file = options.groups.empty() ? groups_file(options.from) : options.groups;
    return file.empty() ? std::map<std::string, std::string>() : trainee_groups(file);
}

}  // namespace

std::filesystem::path groups_file(const std::vector<std::filesystem::path>& from) {
    for (const std::filesystem::path& folder : from)
        if (const auto file = folder / groups_file_name; std::filesystem::is_regular_file(file)) return file;
    return {};
}

std::vector<std::filesystem::path> recordings_in(const std::vector<std::filesystem::path>& from) {
    std::vector<std::filesystem::path> all;
    std::set<std::filesystem::path> known;
    const auto add = [&](const std::filesystem::path& file) {
        if (known.insert(std::filesystem::weakly_canonical(file)).second) all.push_back(file);
    };
    for (const std::filesystem::path& path : from) {
        if (std::filesystem::is_directory(path)) {
            auto found = recordings_of_folder(path);
            std::ranges::sort(found);
            for (const auto& file : found) add(file);
        } else if (std::filesystem::exists(path)) {
            add(path);
        } else {
            throw std::runtime_error(path.string() + ": there is no such recording or folder");
        }
    }
    return all;
}

void run_sessions_study(const SessionsStudyOptions& options, const StudySurroundings& surroundings) {
    const auto files = recordings_in(options.from);
    const auto groups = groups_of(options);
    StudyRun run(options.out, surroundings);
    SessionStore store(options.out / "sessions.sqlite", options.version);
    std::vector<std::string> skipped;
    const auto skip = [&](const std::string& why) {
        skipped.push_back(why);
        surroundings.progress << "left out: " << printable(why) << '\n';
    };
    std::vector<Recording> recordings;
    std::set<std::string> digests;
    for (const std::filesystem::path& file : files) {
        try {
            PacketReader{file};  // what is no recording is not read to its end
            const std::string digest = digest_of_file(file);
            if (!digests.insert(digest).second) continue;  // a copy
            recordings.push_back({file, digest, store.find(digest)});
        } catch (const std::runtime_error& error) {
            skip(error.what());
        }
    }
    const auto planned = run.plan(
        recordings, [](const Recording& recording) { return recording.digest; }, &read);
    if (!run.perform()) return;
    std::vector<SessionRecord> sessions;
    auto recording = recordings.begin();
    for (const Read& outcome : planned.outcomes()) {
        if (!outcome.why_not.empty()) {
            skip(outcome.why_not);
        } else {
            if (!recording->kept) store.keep(outcome.record);
            sessions.push_back(outcome.record);
            SessionRecord& record = sessions.back();
            record.file = printable(recording->file.string());
            record.report = report_address(recording->file, options.out);
            if (const auto group = groups.find(record.trainee); group != groups.end())
                record.group = group->second;
        }
        ++recording;
    }
    if (sessions.empty()) {
        run.forget_outcomes();
        throw std::runtime_error("no recording can be read to its end");
    }
    std::ranges::stable_sort(sessions, {}, &SessionRecord::began_unix_ns);
    if (!options.database.empty()) add_to_database(options.database, sessions);
    write_text(sessions_csv(sessions), options.out / "sessions.csv");
    const Overview overview(sessions, options.compare);
    for (const LearningCurve& curve : overview.learning_curves())
        write_text(curve.svg + "\n", options.out / (curve.name + ".svg"));
    write_text(overview.html(skipped), options.out / "sessions.html");
    run.say("{} sessions{} in {}", sessions.size(),
            skipped.empty() ? "" : fmt::format(", {} left out,", skipped.size()),
            (options.out / "sessions.html").string());
}

}  // namespace osteomill::study
