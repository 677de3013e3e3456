// Reader of the packets of a recording (see packet.h), or of files that editcap and mergecap made of
// recordings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/recording/packet.h"

struct pcap;

namespace osteomill {

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

}  // namespace osteomill
