#include "analysis/output/repeated/manifest.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "analysis/output/output_files.h"
#include "common/files/input_file.h"
#include "common/text/address_text.h"
#include "common/text/foreign_json.h"

namespace osteomill::study {

namespace {

using nlohmann::ordered_json;

/// As Linux names it.
std::string processor() {
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

ordered_json settings_of(const CLI::App& study) {
    ordered_json settings = ordered_json::object();
    for (const CLI::Option* const option : study.get_options()) {
        const std::string name = option->get_name();
        if (name == "--help" || name == "--out" || name == "--merge" || name == "--shard") continue;
        if (option->count() > 0)
            settings[name] = without_passwords(fmt::format("{}", fmt::join(option->results(), ",")));
        else
            settings[name] = option->get_default_str();
    }
    return settings;
}

}  // namespace

std::filesystem::path manifest_of(const std::filesystem::path& folder) {
    return folder / "manifest.json";
}

void write_manifest(const Manifest& made, const CLI::App& study, const std::filesystem::path& folder) {
    utsname system{};
    ::uname(&system);
    write_json({{"program", "osteomill_study"},
                {"version", made.version},
                {"commit", made.commit},
                {"command", made.command},
                {"settings", settings_of(study)},
                {"machine",
                 {{"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
                  {"processor", processor()},
                  {"processors", std::thread::hardware_concurrency()},
                  {"compiler", __VERSION__}}}},
               manifest_of(folder));
}

Manifest read_manifest(const std::filesystem::path& folder) {
    const std::filesystem::path file = manifest_of(folder);
    const std::string text = read_text(file, json_kind);
    try {
        const auto json = parse_foreign_json(text, file.string());
        return {.command = json.at("command").get<std::vector<std::string>>(),
                .version = json.at("version").get<std::string>(),
                .commit = json.at("commit").get<std::string>()};
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(file.string() + ": is no manifest of a study");
    }
}

}  // namespace osteomill::study
