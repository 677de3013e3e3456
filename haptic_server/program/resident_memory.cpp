#include "haptic_server/program/resident_memory.h"

#include <string>

namespace osteomill {

std::optional<std::uint64_t> peak_resident_bytes(std::istream& status) {
    for (std::string key; status >> key;) {
        std::uint64_t kib = 0;
        if (key == "VmHWM:" && status >> kib) return kib * 1024;
        std::getline(status, key);
    }
    return std::nullopt;
}

}  // namespace osteomill
