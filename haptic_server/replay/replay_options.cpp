#include "haptic_server/replay/replay_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "analysis/surface/mesh_file.h"
#include "common/files/distinct_files.h"
#include "common/program/command_options.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr double slowest = 0.01;
constexpr double fastest = 1000.0;

/// A file or folder that is made of the recording.
struct Output {
    const char* option;
    std::optional<std::filesystem::path> ReplayOptions::*file;
    const char* type_name;
    const char* help;
};
using Options = ReplayOptions;
constexpr std::array outputs{
    Output{"--json", &Options::json, "FILE", "Write the same to this file; serve nobody"},
    Output{"--csv", &Options::csv, "FILE",
           "Write force and depth, a line a tick, as haptic_server --log-csv does; of a recording "
           "that holds no ticks, as --states-csv; serve nobody"},
    Output{"--states-csv", &Options::states_csv, "FILE",
           "Write time, pose, force, burr, spindle, removed volume and the nearest structure, a line "
           "a frame; serve nobody"},
    Output{"--trajectory", &Options::trajectory, "FILE.csv",
           "Write the hand's motion, for another session that makes it again (haptic_server "
           "--grip rails --trajectory FILE); serve nobody"},
    Output{"--surface", &Options::surface, "FILE",
           "Write the surface of the bone as it is at the end, closed, in mm of patient LPS, to this "
           ".stl, .ply or .obj; serve nobody"},
    Output{"--difference", &Options::difference, "FILE",
           "Write what was removed of each voxel, 0 to 255, to this .nrrd; serve nobody"},
    Output{"--sound", &Options::sound, "FILE", "Write what the burr sounds like to this .wav; serve nobody"},
    Output{"--hdf5", &Options::hdf5, "FILE",
           "Write all that is in it, in units, to this .h5 or .hdf5 (docs/hdf5.md); serve nobody"},
    Output{"--report", &Options::report, "DIR",
           "Write the session's report (report.html, metrics.csv, metrics.json: docs/metrics.md) into "
           "this folder; serve nobody"},
    Output{"--film", &Options::film, "FILE.mp4",
           "Make a film of it with render_client, as it does with --replay FILE --film; serve nobody"}};

void require_ending(const char* option, const std::optional<std::filesystem::path>& file,
                    const char* ending) {
    if (file && file->extension() != ending)
        throw std::invalid_argument(fmt::format("{}: '{}' must end in {}", option, file->string(), ending));
}

std::vector<NamedFile> files_of(const ReplayOptions& options, const AccessOptions& access) {
    std::vector<NamedFile> files = access.files_read();
    files.push_back({"FILE", options.recording, false});
    for (const Output& output : outputs)
        if (output.file != &Options::report && options.*output.file)
            files.push_back({output.option, *(options.*output.file)});
    if (options.hdf5 && options.layout == Hdf5Layout::fivrs_v3)
        files.push_back({"--layout", fivrs_v3_file(*options.hdf5)});
    if (options.report) {
        constexpr std::array names{"report.html", "metrics.csv", "metrics.json"};
        const std::vector<NamedFile> report = files_written_in("--report", *options.report, names);
        files.insert(files.end(), report.begin(), report.end());
    }
    return files;
}

/// FIVRS's programs read every .hdf5 of a folder and nothing else.
void require_hdf5_name(const ReplayOptions& options, bool has_layout) {
    if (!options.hdf5) {
        if (has_layout) throw std::invalid_argument("--layout: goes with --hdf5");
        return;
    }
    const std::string ending = options.hdf5->extension().string();
    const bool is_ours = options.layout == Hdf5Layout::osteomill;
    if (ending != ".hdf5" && !(is_ours && ending == ".h5"))
        throw std::invalid_argument(fmt::format("--hdf5: '{}' must end in {}", options.hdf5->string(),
                                                is_ours ? ".h5 or .hdf5"
                                                        : ".hdf5, which FIVRS's programs "
                                                          "look for"));
}

}  // namespace

bool ReplayOptions::only_reads() const {
    return info || std::ranges::any_of(outputs, [this](const Output& output) {
               return output.file != &ReplayOptions::film && this->*output.file;
           });
}

ReplayCommandLine parse_replay_command_line(int argc, const char* const* argv, const std::string& version) {
    ReplayOptions options;
    std::string listen = "127.0.0.1:7010";
    std::string layout = hdf5_layout_names.front();
    CommandOptions app(
        "Shows a recording of haptic_server --record to render clients, from the moment that the first one "
        "joins; or says what is in it.",
        "packet_replay", fmt::format("packet_replay {}", version));
    app.add_option("FILE", options.recording, "The recording").required();
    const CommandOption where =
        app.add_option("--listen", listen, "Where clients connect, port 0: any free one")
            .type_name("ADDRESS:PORT")
            .shows_default();
    const AccessOptions access(app);
    const CommandOption speed = app.add_option("--speed", options.speed, "Recorded seconds a second")
                                    .check(within(slowest, fastest))
                                    .shows_default();
    const CommandOption from =
        app.add_option("--from-s", options.from_s, "Begin so long after the recording's beginning")
            .check(not_below_zero());
    app.add_flag("--info", options.info,
                 "Print duration, rates, burrs, removed volume by tissue, checksum; serve nobody");
    for (const Output& output : outputs)
        app.add_option(output.option, options.*output.file, output.help).type_name(output.type_name);
    const CommandOption of_hdf5 =
        app.add_option(
               "--layout", layout,
               "Layout of --hdf5: our own, or that of FIVRS's recordings for its analysis programs; fivrs-v3 "
               "writes a second file beside it, in the folder v3")
            .check(one_of({hdf5_layout_names.begin(), hdf5_layout_names.end()}))
            .shows_default();
    const CommandOption of_report =
        app.add_option("--language", options.report_language, "Language of --report")
            .check(one_of(languages()))
            .shows_default();
    if (auto text = app.parse_or_text(argc, argv)) return {std::nullopt, *std::move(text)};
    options.layout =
        static_cast<Hdf5Layout>(std::ranges::find(hdf5_layout_names, layout) - hdf5_layout_names.begin());
    if (options.surface && !is_mesh_name(*options.surface))
        throw std::invalid_argument(
            fmt::format("--surface: '{}' must end in {}", options.surface->string(), mesh_endings));
    require_ending("--difference", options.difference, ".nrrd");
    require_ending("--sound", options.sound, ".wav");
    require_hdf5_name(options, of_hdf5.count() > 0);
    if (of_report.count() > 0 && !options.report)
        throw std::invalid_argument("--language: goes with --report");
    require_distinct(files_of(options, access));
    if (options.film && (options.only_reads() || where.count() > 0))
        throw std::invalid_argument("--film: goes with --speed and --from-s alone");
    for (const CommandOption serving : {where, speed, from})
        if (options.only_reads() && serving.count() > 0)
            throw std::invalid_argument(fmt::format(
                "{} is for showing a recording; --info, --json, --csv, --states-csv, "
                "--trajectory, --surface, --difference, --sound, --hdf5 and --report read all of it",
                serving.name()));
    options.listen = said_of_option("--listen", [&] { return parse_listen_address(listen); });
    options.access = access.access_to(options.listen);
    return {options, {}};
}

}  // namespace osteomill
