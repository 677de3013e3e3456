// The command line of haptic_server.
//
// The way of an option: declared in typed_server_options.cpp or, if it is a device's, in its entry in
// haptic_server/session/devices; --device here, --tls-* in common/net/tls_options.cpp and --insecure-network
// in haptic_server/streaming/access_options.cpp; checked in server_options.cpp; ServerOptions here;
// server.cpp makes SessionOptions of it (session/session_assembly.h); the part that it concerns gets it,
// mostly through MillingSessionOptions (simulation/loop/milling_session.h).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/program/run_program.h"
#include "devices/simulated/hand_and_arm.h"
#include "haptic_server/program/session_outputs.h"
#include "haptic_server/session/device_table.h"
#include "haptic_server/streaming/access_options.h"
#include "simulation/loop/milling_session.h"

namespace osteomill {

/// Options of haptic_server for the device that moves the tool.
struct DeviceChoice {
    const DeviceEntry* entry = &devices().front();
    PrepareDevice prepare = entry->checked(TypedOptions());
    std::vector<NamedFile> files_read{};  ///< by the typed option
    bool lists_devices = false;           ///< and does nothing else
};

class DeviceOptions {
  public:
    /// Adds the options. Outlives the parsing.
    void declare(CommandOptions& app);
    /// After parsing. Throws std::invalid_argument with one line for options that do not go together.
    DeviceChoice checked() const;

  private:
    std::string device_ = devices().front().name;
    std::map<std::string, std::string> texts_;  // by flag; empty: not typed
    bool lists_devices_ = false;
};

struct ServerOptions {
    SceneChoice scene;
    DeviceChoice device;
    std::optional<Grip> grip = Grip::firm;  ///< nothing: on rails
    MillingSessionOptions milling;          ///< of the two loops
    LogFiles logs;
    std::optional<ListenAddress> listen;  ///< nullopt: nobody is served
    Access access;
    bool waits_for_client = false;           ///< the session's time begins with one
    std::optional<ListenAddress> metrics;    ///< where Prometheus may ask; on this machine
    std::vector<std::string> metrics_hosts;  ///< names by which it may be asked, beside localhost
    bool logs_json = false;
    std::optional<std::filesystem::path> operators;  ///< who of the clients may move the tool; nullopt: any
    std::optional<std::filesystem::path> controls;   ///< a script of them
    std::optional<std::filesystem::path> record;     ///< with a report, too: recording_in() its folder
    bool records_ticks = true;                       ///< not only states
    OutputFiles outputs;
    std::vector<NamedFile> files;  ///< all that were named, to read and to write
    std::string trainee;
    std::string case_name;        ///< for people; empty: the scene is of no case
    bool checks_machine = false;  ///< checks, and does nothing else
    /// Measures the arm into that profile, and does nothing else.
    std::optional<std::filesystem::path> measures_into{};
};

using CommandLine = ParseResult<ServerOptions>;

/// Throws std::invalid_argument with one line for wrong usage.
CommandLine parse_command_line(int argc, const char* const* argv, const std::string& version);

}  // namespace osteomill
