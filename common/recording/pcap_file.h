// Reader and writer of a recording's pcap file: packets, each one frame of a session and when it was sent.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct pcap;

namespace osteomill {

// A recording is a pcap file: nanosecond time stamps, link type USER0 (147), in each packet the bytes of one
// protobuf message osteomill.v2.ServerFrame with its seal (see sealed_frame.h) and without the length that
// goes before it on the wire. The message repeats the packet's time stamp, so that its seal covers that, too.
// tcpdump, editcap, mergecap and Wireshark open, cut and join it.

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

/// Reader of the packets of a recording, or of files that editcap and mergecap made of
/// recordings.
class PacketReader {
  public:
    /// Throws RecordingError for a file that is not there, is no pcap or pcapng file, or is a capture of
    /// something else.
    explicit PacketReader(std::filesystem::path file);

    /// The next packet; nothing at the end of the file, or of its undamaged part (see is_truncated). Throws
    /// RecordingError for a packet that is not of a recording, and for one that claims to go beyond the end
    /// of the file although whole ones follow it: its header is damaged.
    std::optional<Packet> next();

    /// Once next() has come to the end: whether the file ends within a packet, as a crash leaves it.
    bool is_truncated() const { return is_truncated_; }

    /// The place of the next packet.
    PacketPlace place() const;
    /// Goes on from there: a place() of this file.
    void seek(const PacketPlace& place);

    /// "FILE, packet 12 at byte 3456: " before what is wrong.
    std::string where(const PacketPlace& place) const;

  private:
    struct Close {
        void operator()(pcap* file) const;
    };
    bool is_followed_by_packets(const PacketPlace& place) const;

    std::filesystem::path file_;
    std::uint64_t file_bytes_ = 0;
    std::unique_ptr<pcap, Close> input_;
    std::uint64_t next_number_ = 1;
    bool is_truncated_ = false;
};

/// Writer of packets into a recording, each at once: written packets are in the file whatever
/// happens to the program. It waits for the disk: threads that must not use RecordingWriter. While it waits
/// no stream of stdio is locked: from glibc 2.41 on, the end of a program waits for each such lock.
class PacketWriter {
  public:
    /// Makes the file or empties it. Throws RecordingError.
    explicit PacketWriter(std::filesystem::path file);

    /// `message`: at most largest_frame_bytes. Throws RecordingError, such as for a full disk; the file then
    /// ends with the last whole packet, and the next one goes behind that if the disk has space by then.
    void write(Stamp stamp, std::string_view message);

    const std::filesystem::path& file() const { return file_; }
    std::uint64_t packets() const { return packets_; }
    std::uint64_t bytes() const { return whole_bytes_; }

  private:
    class Format;
    struct Close {
        void operator()(Format* format) const;
        void operator()(std::FILE* opened) const;
    };
    int write_all(std::string_view bytes);  // 0, or why not: as errno
    [[noreturn]] void fail(int reason);

    std::filesystem::path file_;
    std::unique_ptr<std::FILE, Close> opened_;  // written by its descriptor, not through stdio
    std::unique_ptr<Format, Close> format_;
    std::uint64_t packets_ = 0;
    std::uint64_t whole_bytes_ = 0;  // up to the last whole packet
};

}  // namespace osteomill
