#include "haptic_server/program/session_outputs.h"

#include <fmt/format.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "analysis/report/write_report.h"
#include "common/log/line_stream.h"
#include "common/log/log.h"
#include "common/program/progress.h"
#include "common/words/translation.h"
#include "imaging/case/case_placement.h"

namespace osteomill {

std::filesystem::path recording_in(const std::filesystem::path& folder) {
    return folder / "session.pcap";
}

void prepare_report_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("--report {}: cannot make the folder: {}", folder.string(), error.message()));
    for (const char* name : {"session.pcap", "report.html", "metrics.csv", "metrics.json"})
        if (std::filesystem::exists(std::filesystem::symlink_status(folder / name)))
            throw std::runtime_error(fmt::format(
                "--report {}: holds a session already ({}); name another folder", folder.string(), name));
}

namespace {

/// Writes one thing after the other although one of them fails; keeps the first failure and logs the others.
class FirstFailure {
  public:
    template <typename Write>
    void of(Write&& write_one) {
        try {
            write_one();
        } catch (const std::exception& error) {
            if (line_.empty())
                line_ = error.what();
            else
                log_error("{}", error.what());
        }
    }
    void require_none() const {
        if (!line_.empty()) throw std::runtime_error(line_);
    }

  private:
    std::string line_;
};

/// A bone of which saving takes long says how far it has come.
void save_and_tell(const std::filesystem::path& path, const BoneSource& source, const Bone& bone,
                   LineStream& out) {
    constexpr std::uint64_t many_voxels = std::uint64_t{1} << 28;
    const bool takes_long = source.file && voxel_count(bone.grid()) > many_voxels;
    LineStreamBuffer buffer(out);
    std::ostream messages(&buffer);
    messages << std::unitbuf;
    ProgressLine progress(messages, out.is_terminal(), "saving");
    save_bone(path, source, bone, [&](double done) {
        if (takes_long) progress.report(done);
    });
}

}  // namespace

EndPlaces::EndPlaces(const OutputFiles& files) : files_(files) {
    if (files.save_bone) save_bone_.emplace(*files.save_bone);
    if (files.json) json_.emplace(*files.json);
    if (files.json_histograms) histograms_.emplace(*files.json_histograms);
    if (files.report) report_.emplace(*files.report / "report.html");
}

OutputFiles EndPlaces::now() const {
    OutputFiles files = files_;
    if (save_bone_) files.save_bone = save_bone_->now();
    if (json_) files.json = json_->now();
    if (histograms_) files.json_histograms = histograms_->now();
    return files;
}

std::vector<std::string> EndPlaces::check(const BoneSource& source) {
    constexpr std::chrono::milliseconds between_checks{500};
    next_check_ = std::chrono::steady_clock::now() + between_checks;
    std::vector<std::string> lines;
    for (std::optional<OutputPlace>* const place : {&save_bone_, &json_, &histograms_})
        if (std::string line = *place ? (*place)->news() : ""; !line.empty())
            lines.push_back(std::move(line));
    if (save_bone_ && !source_is_lost_)
        if (std::string line = why_source_is_lost(source); !line.empty()) {
            source_is_lost_ = true;
            lines.push_back(std::move(line));
        }
    return lines;
}

void write_outputs(SessionAssembly& assembly, const OutputFiles& files, const BoneCost& cost,
                   std::uint64_t peak_bytes, const nlohmann::ordered_json& settings,
                   const ProgramOutput& output) {
    ShownSession* shown = assembly.shown();
    const MillingSessionReport report = assembly.session().report();
    // The outputs that matter most come first, and nothing waits for a client that is slow to read the end.
    FirstFailure failure;
    failure.of([&] {
        if (files.save_bone)
            save_and_tell(*files.save_bone, assembly.source(), assembly.session().bone(), *output.err);
    });
    failure.of([&] {
        if (files.case_folder && shown && shown->placed())
            remember_placement(*files.case_folder, *shown->placed());
    });
    failure.of([&] { assembly.logs().close_force(); });
    failure.of([&] { assembly.logs().close_milling(); });
    if (shown) shown->server().finish_recording();
    const auto recording = shown ? shown->server().recording() : std::nullopt;
    if (recording && recording->missed_ticks > 0)
        log_warning("{}: {} ticks are missing: the disk could not keep up", recording->file.string(),
                    recording->missed_ticks);
    failure.of([&] {
        if (!files.json) return;
        auto json = session_json(report, cost, peak_bytes, assembly.scene(), assembly.options());
        json["settings"] = settings;
        if (shown) add_structures(json, shown->structures(), assembly.scene());
        if (recording) json["recording"] = recorded(*recording);
        write_json(json, *files.json);
    });
    failure.of([&] {
        if (files.json_histograms) write_json(histograms_us(report), *files.json_histograms);
    });
    failure.of([&] {
        const auto say_how_to_report = [&](const std::filesystem::path& of) {
            if (files.report && std::filesystem::exists(of))
                log_error("once there is room on the disk, packet_replay {} --report {} makes the report",
                          of.string(), files.report->string());
        };
        if (recording && !recording->error.empty()) {
            say_how_to_report(recording->file);
            throw std::runtime_error(ending_of(*recording));
        }
        if (!files.report) return;
        // Clients have had the end by now, and all else lies on the disk.
        output.out->say("the session has ended; its report is being made");
        speak(files.report_language);
        const std::string error = write_report(recording_in(*files.report), *files.report, [](double) {});
        if (!error.empty()) {
            say_how_to_report(recording_in(*files.report));
            throw std::runtime_error(error);
        }
        output.out->say(fmt::format("report: {}", (*files.report / "report.html").string()));
    });
    if (shown) shown->server().stop();
    failure.of([&] {
        if (shown && shown->server().mirror_checksum() != report.bone_checksum)
            throw std::runtime_error(
                fmt::format("the bone that clients were shown ({:016x}) is not the one milled ({:016x})",
                            shown->server().mirror_checksum(), report.bone_checksum));
    });
    failure.require_none();
}

}  // namespace osteomill
