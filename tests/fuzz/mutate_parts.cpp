#include "tests/fuzz/mutate_parts.h"

#include <algorithm>
#include <utility>

#include "common/wire/sealed_frame.h"

namespace osteomill::fuzz {

namespace {

/// By how much one mutation may lengthen a part.
constexpr std::size_t growth_bytes = 64;

std::string mutated(std::string part) {
    const std::size_t size = part.size();
    part.resize(size + growth_bytes);
    part.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(part.data()), size, part.size()));
    return part;
}

}  // namespace

void mutate_parts(std::vector<std::string>& parts, std::mt19937& random) {
    if (parts.empty()) parts.emplace_back();
    const auto any = [&] { return static_cast<std::ptrdiff_t>(random() % parts.size()); };
    switch (random() % 10) {
        case 0:
            parts.erase(parts.begin() + any());
            return;
        case 1:
            parts.insert(parts.begin() + any(), std::string(parts[static_cast<std::size_t>(any())]));
            return;
        case 2:
            std::iter_swap(parts.begin() + any(), parts.begin() + any());
            return;
        default: {
            std::string& part = parts[static_cast<std::size_t>(any())];
            part = mutated(std::move(part));
        }
    }
}

std::vector<std::string> messages_of(std::string_view stream) {
    FrameDecoder decoder;
    decoder.append({reinterpret_cast<const std::uint8_t*>(stream.data()), stream.size()});
    std::vector<std::string> messages;
    while (const auto message = decoder.next()) messages.emplace_back(message->begin(), message->end());
    return messages;
}

std::string stream_of(const std::vector<std::string>& messages) {
    std::string stream;
    for (const std::string& message : messages)
        if (!message.empty() && message.size() <= largest_frame_bytes) append_frame(message, stream);
    return stream;
}

std::string resealed(const std::string& message) {
    v2::ServerFrame frame;
    if (!frame.ParseFromString(message)) return message;
    frame.clear_frame_checksum();
    if (frame.ByteSizeLong() + seal_bytes > largest_frame_bytes) return message;
    std::string stream;
    append_sealed_frame(frame, stream);
    return messages_of(stream).at(0);
}

std::size_t put(const std::string& mutated, std::uint8_t* data, std::size_t size, std::size_t most) {
    if (mutated.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::ranges::copy(mutated, data);
    return mutated.size();
}

}  // namespace osteomill::fuzz
