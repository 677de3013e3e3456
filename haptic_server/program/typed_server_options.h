// Options of haptic_server as typed, before they are checked against each other (server_options.h).
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "haptic_server/program/device_options.h"
#include "simulation/force_models/force_models.h"

namespace CLI {
class App;
}

namespace osteomill {

struct TypedServerOptions {
    std::string scene;
    std::string case_name;
    std::string bone;
    std::vector<std::string> changes;
    std::string burr;
    double spindle_rpm = 0.0;
    DeviceOptions device;
    std::string grip = "firm";
    std::string trajectory;
    std::string coupling;
    std::string force_model = force_model_names().front();
    double milling_rate_hz = 0.0;
    bool vibration = false;
    std::string clock = "real";
    int haptic_cpu = -1;
    int milling_cpu = -1;
    double duration_s = std::numeric_limits<double>::infinity();
    std::string listen;
    std::string metrics;
    bool log_json = false;
    std::string operators;
    std::string controls;
    std::string record;
    std::string record_rate_hz = "1000";
    std::string save_bone;
    std::string json;
    std::string report;
    std::string trainee;
    std::string log_csv;
    std::string log_milling_csv;
    bool check = false;
};

/// Declares the options with their help and ranges; parsing fills in `typed`, which outlives `app`.
void declare(CLI::App& app, TypedServerOptions& typed);

}  // namespace osteomill
