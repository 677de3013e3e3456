// Manifest of a folder of results: what was run, with which program, on which machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace osteomill::study {

struct Manifest {
    std::vector<std::string> command;  ///< the study and its options, without --out, --jobs and --shard
    std::string version;
    std::string commit;
};

/// FOLDER/manifest.json
std::filesystem::path manifest_of(const std::filesystem::path& folder);

/// Writes FOLDER/manifest.json: `made`, every setting of `study` with the values that were not given, too,
/// and this machine. Throws std::runtime_error in one line where it cannot be written.
void write_manifest(const Manifest& made, const CLI::App& study, const std::filesystem::path& folder);

/// Throws std::runtime_error in one line naming a file that is none.
Manifest read_manifest(const std::filesystem::path& folder);

}  // namespace osteomill::study
