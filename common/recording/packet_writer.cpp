#include "common/recording/packet_writer.h"

#include <pcap/pcap.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "common/wire/frame.h"

namespace osteomill {

namespace {

constexpr std::uint64_t file_header_bytes = 24;
constexpr std::uint64_t packet_header_bytes = 16;

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
    output_.reset(pcap_dump_fopen(format_.get(), stream));
    if (!output_ || pcap_dump_flush(output_.get()) != 0) {
        const int reason = errno;
        if (!output_) std::fclose(stream);
        throw RecordingError(file_.string() + ": cannot write the recording: " + std::strerror(reason));
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
    errno = 0;
    pcap_dump(reinterpret_cast<u_char*>(output_.get()), &header,
              reinterpret_cast<const u_char*>(message.data()));
    // pcap_dump says nothing of failures; stdio remembers them.
    if (pcap_dump_flush(output_.get()) != 0 || std::ferror(pcap_dump_file(output_.get())) != 0) give_up();
    ++packets_;
    whole_bytes_ += packet_header_bytes + message.size();
}

void PacketWriter::give_up() {
    const int reason = errno;
    const int descriptor = ::fileno(pcap_dump_file(output_.get()));
    // A packet that is torn would be no harm, but some tools complain of it. Where it cannot be cut off it
    // stays.
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor, static_cast<off_t>(whole_bytes_));
    throw RecordingError(file_.string() + ": the recording ends after " + std::to_string(packets_) +
                         " frames: " + (reason != 0 ? std::strerror(reason) : "it cannot be written"));
}

}  // namespace osteomill
