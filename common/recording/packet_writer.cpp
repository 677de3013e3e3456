#include "common/recording/packet_writer.h"

#include <pcap/pcap.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "common/wire/frame.h"

namespace osteomill {

namespace {

constexpr std::uint64_t file_header_bytes = 24;

}  // namespace

void PacketWriter::Close::operator()(pcap* format) const {
    pcap_close(format);
}

void PacketWriter::Close::operator()(pcap_dumper* output) const {
    pcap_dump_close(output);
}

PacketWriter::PacketWriter(std::filesystem::path file)
    : file_(std::move(file)),
      format_(pcap_open_dead_with_tstamp_precision(DLT_USER0, static_cast<int>(largest_frame_bytes),
                                                   PCAP_TSTAMP_PRECISION_NANO)) {
    if (!format_) throw std::bad_alloc();
    std::FILE* stream = std::fopen(file_.c_str(), "wbe");
    if (stream == nullptr)
        throw RecordingError(file_.string() + ": cannot write the recording: " + std::strerror(errno));
    // Each packet is flushed anyway. What stdio holds for a disk that does not answer it would try to write
    // once more when the program ends, for ever.
    std::setvbuf(stream, nullptr, _IONBF, 0);
    output_.reset(pcap_dump_fopen(format_.get(), stream));
    if (!output_ || pcap_dump_flush(output_.get()) != 0) {
        // Where it makes no output of the stream, libpcap has closed it.
        throw RecordingError(file_.string() + ": cannot write the recording: " + std::strerror(errno));
    }
    whole_bytes_ = file_header_bytes;
}

void PacketWriter::write(Stamp stamp, std::string_view message) {
    using namespace std::chrono;
    if (message.size() > largest_frame_bytes)
        throw RecordingError(file_.string() + ": a frame of " + std::to_string(message.size()) +
                             " bytes does not fit a recording");
    const auto whole_s = floor<seconds>(stamp);
    pcap_pkthdr header{};
    header.ts.tv_sec = whole_s.time_since_epoch().count();
    header.ts.tv_usec = (stamp - whole_s).count();  // nanoseconds: this file's precision
    header.caplen = header.len = static_cast<bpf_u_int32>(message.size());
    std::FILE* stream = pcap_dump_file(output_.get());
    std::clearerr(stream);
    errno = 0;
    pcap_dump(reinterpret_cast<u_char*>(output_.get()), &header,
              reinterpret_cast<const u_char*>(message.data()));
    // pcap_dump says nothing of failures; stdio remembers them.
    if (pcap_dump_flush(output_.get()) != 0 || std::ferror(stream) != 0) fail();
    ++packets_;
    whole_bytes_ += packet_header_bytes + message.size();
}

void PacketWriter::fail() {
    const int reason = errno;
    std::FILE* stream = pcap_dump_file(output_.get());
    const auto whole = static_cast<off_t>(whole_bytes_);
    // What could not be written must not turn up behind what comes later.
    ::__fpurge(stream);
    // A packet that is torn would be no harm at the end, but some tools complain of it. Where it cannot be
    // cut off it stays, until another is written over it.
    [[maybe_unused]] const int ignored =
        ::ftruncate(::fileno(stream), whole) + ::fseeko(stream, whole, SEEK_SET);
    throw RecordingError(
        file_.string() + ": no more than " + std::to_string(packets_) +
        " frames could be written: " + (reason != 0 ? std::strerror(reason) : "it cannot be written"));
}

}  // namespace osteomill
