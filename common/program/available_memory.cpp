#include "common/program/available_memory.h"

#include <fstream>
#include <sstream>
#include <string>

namespace osteomill {

std::optional<std::uint64_t> available_memory_bytes(const std::filesystem::path& meminfo) {
    std::ifstream file(meminfo);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name;
        std::uint64_t kibibytes = 0;
        if (words >> name && name == "MemAvailable:" && words >> kibibytes) return kibibytes * 1024;
    }
    return std::nullopt;
}

}  // namespace osteomill
