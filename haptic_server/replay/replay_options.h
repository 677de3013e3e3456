// The command line of packet_replay.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "analysis/hdf5/recording_hdf5.h"
#include "common/program/run_program.h"
#include "haptic_server/streaming/access_options.h"

namespace osteomill {

struct ReplayOptions {
    std::filesystem::path recording;
    ListenAddress listen;
    Access access;
    double speed = 1.0;
    double from_s = 0.0;
    bool info = false;  ///< print the recording's contents
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> csv;  ///< one row per tick, if the recording holds ticks
    std::optional<std::filesystem::path> states_csv;
    std::optional<std::filesystem::path> trajectory;  ///< for haptic_server --trajectory
    std::optional<std::filesystem::path> surface;     ///< the surface of the bone that is left
    std::optional<std::filesystem::path> difference;  ///< the bone removed since the recording began
    std::optional<std::filesystem::path> sound;       ///< the burr's sound, as WAV
    std::optional<std::filesystem::path> hdf5;        ///< for Python and MATLAB
    Hdf5Layout layout = Hdf5Layout::osteomill;        ///< the HDF5 file's layout
    std::optional<std::filesystem::path> report;      ///< folder for the session's report
    std::string report_language = "en";               ///< one of languages()
    std::optional<std::filesystem::path> film;        ///< for render_client, which draws it

    /// Whether the recording is only evaluated, and shown to nobody.
    bool only_reads() const;
};

using ReplayCommandLine = ParseResult<ReplayOptions>;

/// Throws std::invalid_argument with one line for wrong usage.
ReplayCommandLine parse_replay_command_line(int argc, const char* const* argv, const std::string& version);

}  // namespace osteomill
