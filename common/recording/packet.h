// A packet of a recording: one frame of a session, and when it was sent.
//
// A recording is a pcap file: nanosecond time stamps, link type USER0 (147), in each packet the bytes of one
// protobuf message osteomill.v2.ServerFrame with its seal (see sealed_frame.h) and without the length that
// goes before it on the wire. The message repeats the packet's time stamp, so that its seal covers that, too.
// tcpdump, editcap, mergecap and Wireshark open, cut and join it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace osteomill {

/// When a frame was sent, UTC. In a server's recording: when the session began, or the server if the session
/// waited for a client, plus the session's time.
using Stamp = std::chrono::sys_time<std::chrono::nanoseconds>;

/// The header before each packet of a pcap file: two numbers of time, the bytes kept, the bytes that there
/// were.
inline constexpr std::size_t packet_header_bytes = 16;

/// A packet's place in its file.
struct PacketPlace {
    std::uint64_t number = 1;        ///< as Wireshark counts
    std::uint64_t offset_bytes = 0;  ///< where its header begins
};

struct Packet {
    PacketPlace place;
    Stamp stamp;
    std::span<const std::uint8_t> message;  ///< until the next packet is read
};

/// A recording cannot be written or read: one line with the file, and where in it.
struct RecordingError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace osteomill
