#include "common/recording/packet_writer.h"

#include <fmt/format.h>
#include <pcap/pcap.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "common/wire/frame.h"

namespace osteomill {

/// Bytes of a pcap file, which libpcap writes into memory.
class PacketWriter::Format {
  public:
    Format()
        : format_(pcap_open_dead_with_tstamp_precision(DLT_USER0, static_cast<int>(largest_frame_bytes),
                                                       PCAP_TSTAMP_PRECISION_NANO)) {
        std::FILE* memory = ::open_memstream(&bytes_, &size_);
        // If it makes no output of the stream, libpcap has closed it.
        if (format_ != nullptr && memory != nullptr) output_ = pcap_dump_fopen(format_, memory);
        if (output_ == nullptr) throw std::bad_alloc();
    }
    ~Format() {
        pcap_dump_close(output_);
        pcap_close(format_);
        std::free(bytes_);
    }
    Format(const Format&) = delete;
    Format& operator=(const Format&) = delete;

    /// The bytes a file begins with, before the first packet; valid until that packet.
    std::string_view file_header() { return flushed(); }

    /// A packet with its header; valid until the next.
    std::string_view packet(Stamp stamp, std::string_view message) {
        using namespace std::chrono;
        const auto whole_s = floor<seconds>(stamp);
        pcap_pkthdr header{};
        header.ts.tv_sec = whole_s.time_since_epoch().count();
        header.ts.tv_usec = (stamp - whole_s).count();  // nanoseconds: this file's precision
        header.caplen = header.len = static_cast<bpf_u_int32>(message.size());
        ::fseeko(pcap_dump_file(output_), 0, SEEK_SET);
        pcap_dump(reinterpret_cast<u_char*>(output_), &header,
                  reinterpret_cast<const u_char*>(message.data()));
        return flushed();
    }

  private:
    std::string_view flushed() {
        // pcap_dump says nothing of failures; stdio remembers them. Memory alone can fail here.
        if (pcap_dump_flush(output_) != 0 || std::ferror(pcap_dump_file(output_)) != 0)
            throw std::bad_alloc();
        return {bytes_, size_};
    }

    pcap_t* format_;
    pcap_dumper_t* output_ = nullptr;
    char* bytes_ = nullptr;
    std::size_t size_ = 0;
};

void PacketWriter::Close::operator()(Format* format) const {
    delete format;
}

void PacketWriter::Close::operator()(std::FILE* opened) const {
    std::fclose(opened);
}

PacketWriter::PacketWriter(std::filesystem::path file)
    : file_(std::move(file)), opened_(std::fopen(file_.c_str(), "wbe")), format_(new Format) {
    if (!opened_)
        throw RecordingError(file_.string() + ": cannot write the recording: " + std::strerror(errno));
    const std::string_view header = format_->file_header();
    if (const int reason = write_all(header); reason != 0)
        throw RecordingError(file_.string() + ": cannot write the recording: " + std::strerror(reason));
    whole_bytes_ = header.size();
}

void PacketWriter::write(Stamp stamp, std::string_view message) {
    if (message.size() > largest_frame_bytes)
        throw RecordingError(file_.string() + ": a frame of " + std::to_string(message.size()) +
                             " bytes does not fit a recording");
    const std::string_view packet = format_->packet(stamp, message);
    if (const int reason = write_all(packet); reason != 0) fail(reason);
    ++packets_;
    whole_bytes_ += packet.size();
}

int PacketWriter::write_all(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(::fileno(opened_.get()), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

void PacketWriter::fail(int reason) {
    const int descriptor = ::fileno(opened_.get());
    const auto whole = static_cast<off_t>(whole_bytes_);
    // A packet that is torn would be no harm at the end, but some tools complain of it. If it cannot be cut
    // off, it stays until another is written over it.
    [[maybe_unused]] const auto ignored =
        ::ftruncate(descriptor, whole) + ::lseek(descriptor, whole, SEEK_SET);
    throw RecordingError(
        file_.string() + ": " +
        fmt::format("no more than {} frames could be written: {}", packets_, std::strerror(reason)));
}

}  // namespace osteomill
