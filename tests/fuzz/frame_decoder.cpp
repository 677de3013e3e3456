#include <algorithm>
#include <vector>

#include "common/wire/frame.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

namespace {

struct Decoded {
    std::vector<std::vector<std::uint8_t>> messages;
    std::string error;
    bool is_inside_frame = false;
};

/// The stream in pieces of `piece_bytes`.
Decoded decode(Bytes stream, std::size_t piece_bytes, std::size_t largest_bytes) {
    FrameDecoder decoder(largest_bytes);
    Decoded decoded;
    for (std::size_t at = 0; at < stream.size(); at += piece_bytes) {
        decoder.append(stream.subspan(at, std::min(piece_bytes, stream.size() - at)));
        while (const auto message = decoder.next()) {
            require(!message->empty() && message->size() <= largest_bytes, "a frame of a length not allowed");
            decoded.messages.emplace_back(message->begin(), message->end());
        }
    }
    decoded.error = decoder.error();
    decoded.is_inside_frame = decoder.is_inside_frame();
    return decoded;
}

}  // namespace

void frame_decoder(Bytes input) {
    if (input.empty()) return;
    const std::size_t piece_bytes = 1 + input[0] % 64U;
    const std::size_t largest_bytes =
        (input[0] & 64U) != 0 ? largest_frame_bytes : largest_client_frame_bytes;
    const Bytes stream = input.subspan(1);

    const Decoded whole = decode(stream, std::max<std::size_t>(stream.size(), 1), largest_bytes);
    const Decoded pieces = decode(stream, piece_bytes, largest_bytes);
    require(whole.messages == pieces.messages, "the pieces in which a stream arrives change its frames");
    require(whole.error == pieces.error, "the pieces in which a stream arrives change what is wrong with it");
    require(whole.error.find('\n') == std::string::npos, "a complaint of several lines");

    std::string encoded;
    for (const auto& message : whole.messages)
        append_frame({reinterpret_cast<const char*>(message.data()), message.size()}, encoded);
    require(encoded.size() <= stream.size() &&
                std::equal(encoded.begin(), encoded.end(), stream.begin(),
                           [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }),
            "frames that do not encode to the bytes that they came from");
    if (whole.error.empty())
        require(whole.is_inside_frame == (encoded.size() < stream.size()),
                "a stream that ends within a frame and does not say so");
}

}  // namespace osteomill::fuzz
