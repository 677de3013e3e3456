// Options of haptic_server as typed, before they are checked against each other (server_options.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptic_server/program/server_options.h"

namespace osteomill {

struct TypedServerOptions {
    ServerOptions options;  ///< so far; the other typed values are yet to be checked or converted
    std::string case_name;
    std::vector<std::string> changes;
    std::string burr;
    DeviceOptions device;
    std::string grip = "firm";
    std::optional<std::string> coupling;
    double milling_rate_hz = 0.0;
    std::string clock = "real";
    std::string listen;
    std::string metrics;
    std::string record_rate_hz = "1000";
    bool measures_arm = false;
    std::string save_profile;
};

/// Declares the options with their help and ranges; parsing fills in `typed`, which outlives `app`.
void declare(CommandOptions& app, TypedServerOptions& typed);

}  // namespace osteomill
