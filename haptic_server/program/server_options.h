// The command line of haptic_server.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "common/program/command_line.h"
#include "devices/simulated/hand_model.h"
#include "haptic_server/program/device_options.h"
#include "haptic_server/streaming/access_options.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

struct ServerOptions : DeviceChoice {
    std::optional<std::string>
        scene;  ///< a phantom's name or a TOML file; absent: the bone's own, or the tooth
    std::optional<std::filesystem::path> bone;
    Grip grip = Grip::firm;
    std::optional<std::filesystem::path> trajectory;
    MillingSessionOptions session;
    std::optional<ListenAddress> listen;  ///< nullopt: nobody is served
    Access access;
    std::optional<std::filesystem::path> operators;  ///< who of the clients may move the tool; nullopt: any
    std::optional<std::filesystem::path> controls;   ///< a script of them
    std::optional<std::filesystem::path> record;     ///< of a report, too: recording_in() its folder
    std::optional<std::filesystem::path> report;     ///< folder
    std::string trainee;
    std::string case_name;                             ///< for people; empty: of no case
    std::optional<std::filesystem::path> case_folder;  ///< of one that is not built in
    std::optional<std::filesystem::path> save_bone;
    std::optional<std::filesystem::path> json;
    std::optional<std::filesystem::path> json_histograms;  ///< beside json
    std::optional<std::filesystem::path> log_csv;
    std::optional<std::filesystem::path> log_milling_csv;
};

using CommandLine = Asked<ServerOptions>;

/// Throws std::invalid_argument with one line for wrong usage.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

}  // namespace osteomill
