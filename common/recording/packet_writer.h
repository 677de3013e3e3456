// Writer of packets into a recording (see packet.h), each at once: written packets are in the file whatever
// happens to the program. It waits for the disk: threads that must not use RecordingWriter. While it waits no
// stream of stdio is locked: from glibc 2.41 on, the end of a program waits for each such lock.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "common/recording/packet.h"

namespace osteomill {

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
