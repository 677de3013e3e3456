// Mutates the packets of a recording, and seals them again: an unsealed one is refused before it is read at.
#include <cstring>

#include "osteomill/v2/session.pb.h"
#include "tests/fuzz/mutate_parts.h"

namespace {

constexpr std::size_t file_header_bytes = 24;
constexpr std::size_t stamp_bytes = 8;
constexpr std::size_t packet_header_bytes = stamp_bytes + 8;  // the length kept, and the length sent

/// Each with its stamp before the message.
std::vector<std::string> packets_of(std::string_view file) {
    std::vector<std::string> packets;
    file.remove_prefix(std::min(file.size(), file_header_bytes));
    while (file.size() >= packet_header_bytes) {
        std::uint32_t length = 0;
        std::memcpy(&length, file.data() + stamp_bytes, sizeof length);
        if (file.size() - packet_header_bytes < length) break;
        packets.emplace_back(file.substr(0, stamp_bytes)).append(file.substr(packet_header_bytes, length));
        file.remove_prefix(packet_header_bytes + length);
    }
    return packets;
}

std::string packet(const std::string& stamp, const std::string& message) {
    const auto length = static_cast<std::uint32_t>(message.size());
    std::string lengths(sizeof length, '\0');
    std::memcpy(lengths.data(), &length, sizeof length);
    return stamp + lengths + lengths + message;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    using namespace osteomill;
    std::mt19937 random(seed);
    if (size < file_header_bytes || random() % 8 == 0) return LLVMFuzzerMutate(data, size, most);
    const std::string_view file(reinterpret_cast<const char*>(data), size);
    std::vector<std::string> stamps;
    std::vector<std::string> messages;
    for (const std::string& part : packets_of(file)) {
        stamps.push_back(part.substr(0, stamp_bytes));
        messages.push_back(part.substr(stamp_bytes));
    }
    if (random() % 8 == 0)
        fuzz::mutate_parts(stamps, random);
    else
        fuzz::mutate_parts(messages, random);
    if (random() % 2 == 0) fuzz::renumber<v2::ServerFrame>(messages, 1);
    std::string mutated(file.substr(0, file_header_bytes));
    for (std::size_t i = 0; i < messages.size(); ++i) {
        std::string stamp = i < stamps.size() ? stamps[i] : std::string();
        stamp.resize(stamp_bytes);
        mutated += packet(stamp, fuzz::resealed(messages[i]));
    }
    return fuzz::put(mutated, data, size, most);
}
