// Writer of packets into a recording (see packet.h), each at once: written packets are in the file whatever
// happens to the program. It waits for the disk: threads that must not use RecordingWriter.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "common/recording/packet.h"

struct pcap;
struct pcap_dumper;

namespace osteomill {

class PacketWriter {
  public:
    /// Makes the file or empties it. Throws RecordingError.
    explicit PacketWriter(std::filesystem::path file);

    /// `message`: at most largest_frame_bytes. Throws RecordingError, such as for a full disk; the file then
    /// ends with the last whole packet, and the next one goes behind that if there is room by then.
    void write(Stamp stamp, std::string_view message);

    const std::filesystem::path& file() const { return file_; }
    std::uint64_t packets() const { return packets_; }
    std::uint64_t bytes() const { return whole_bytes_; }

  private:
    struct Close {
        void operator()(pcap* format) const;
        void operator()(pcap_dumper* output) const;
    };
    [[noreturn]] void fail();

    std::filesystem::path file_;
    std::unique_ptr<pcap, Close> format_;
    std::unique_ptr<pcap_dumper, Close> output_;
    std::uint64_t packets_ = 0;
    std::uint64_t whole_bytes_ = 0;  // up to the last whole packet
};

}  // namespace osteomill
