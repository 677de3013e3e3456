#include "studies/realtime/installed_program.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace osteomill::study {

std::optional<std::filesystem::path> installed_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        if (std::filesystem::is_regular_file(program) && ::access(program.c_str(), X_OK) == 0) return program;
    }
    return std::nullopt;
}

}  // namespace osteomill::study
