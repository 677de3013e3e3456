// Mutation of data made of parts, each behind its length: bytes inserted anywhere would spoil all lengths
// that follow, and little would get past the first check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "common/wire/frame.h"

namespace osteomill::fuzz {

/// Leaves a part out, tells it twice, swaps two, or lets libFuzzer change one of them.
void mutate_parts(std::vector<std::string>& parts, std::mt19937& random);

/// The messages of a stream of frames, up to the first bad frame; and the stream of messages. Messages that
/// do not fit a frame are left out.
std::vector<std::string> messages_of(std::string_view stream);
std::string stream_of(const std::vector<std::string>& messages);

/// Numbers those that can be parsed from `first` on.
template <typename Frame>
void renumber(std::vector<std::string>& messages, std::uint64_t first) {
    for (std::string& message : messages) {
        Frame frame;
        if (!frame.ParseFromString(message)) continue;
        frame.set_sequence(first++);
        message = frame.SerializeAsString();
    }
}

/// The message with a seal that holds, and without the length before it; as it was if it is no message.
std::string resealed(const std::string& message);

/// Writes `mutated` over `data`, or, if it does not fit, lets libFuzzer mutate `data`.
std::size_t put(const std::string& mutated, std::uint8_t* data, std::size_t size, std::size_t most);

}  // namespace osteomill::fuzz

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace osteomill::fuzz {

/// Mutates the input of a session's target: a byte that selects how the frames are passed, then a stream of
/// frames, which are numbered from `first` on half of the time.
template <typename Frame>
std::size_t mutate_session(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                           std::uint64_t first) {
    std::mt19937 random(seed);
    if (size < 2 || random() % 4 == 0) return LLVMFuzzerMutate(data, size, most);
    const char* const bytes = reinterpret_cast<const char*>(data);
    auto messages = messages_of({bytes + 1, size - 1});
    mutate_parts(messages, random);
    if (random() % 2 == 0) renumber<Frame>(messages, first);
    return put(bytes[0] + stream_of(messages), data, size, most);
}

}  // namespace osteomill::fuzz
