#include "common/recording/pcap_file.h"

#include <fmt/format.h>
#include <pcap/pcap.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "common/wire/frame.h"
#include "common/wire/sealed_frame.h"

namespace osteomill {

namespace {

constexpr std::int64_t latest_s = 7'258'118'400;  // nanoseconds since 1970 in 64 bits end in 2262

constexpr std::size_t kept_bytes_offset = 8;  // in a packet's header
constexpr std::size_t whole_bytes_offset = 12;

/// The most bytes of one packet that libpcap reads before it gives up.
constexpr std::size_t largest_packet_read_bytes = 256 * 1024;

/// Bounds the search for packets in a file that is made to look as if it had one at every byte.
constexpr int most_hashed = 10'000;

}  // namespace

void PacketReader::Close::operator()(pcap* file) const {
    pcap_close(file);
}

PacketReader::PacketReader(std::filesystem::path file) : file_(std::move(file)) {
    const auto refuse = [&](const std::string& why) -> RecordingError {
        return RecordingError(file_.string() + ": " + why);
    };
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_, error))
        throw refuse(error ? error.message() : "is no file; a recording is one, made with --record");
    file_bytes_ = std::filesystem::file_size(file_, error);
    std::FILE* stream = std::fopen(file_.c_str(), "rbe");
    if (stream == nullptr) throw refuse(std::strerror(errno));
    std::array<char, PCAP_ERRBUF_SIZE> why{};
    input_.reset(pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, why.data()));
    if (!input_) {
        std::fclose(stream);
        throw refuse(fmt::format("is no recording, which is a pcap file: {}", why.data()));
    }
    if (const int link_type = pcap_datalink(input_.get()); link_type != DLT_USER0)
        throw refuse(
            fmt::format("is a capture of link type {}, not a recording, which has 147 (USER0)", link_type));
}

std::optional<Packet> PacketReader::next() {
    const PacketPlace here = place();
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    const int outcome = pcap_next_ex(input_.get(), &header, &bytes);
    if (outcome == PCAP_ERROR_BREAK) return std::nullopt;
    if (outcome != 1) {
        if (std::feof(pcap_file(input_.get())) != 0) {
            if (is_followed_by_packets(here))
                throw RecordingError(
                    where(here) +
                    "its length is damaged: it would end behind the end of the file, and whole "
                    "packets follow it");
            is_truncated_ = true;
            return std::nullopt;
        }
        throw RecordingError(where(here) + pcap_geterr(input_.get()));
    }
    ++next_number_;
    if (header->caplen != header->len)
        throw RecordingError(where(here) +
                             fmt::format("only {} of its {} bytes were kept; a recording holds them all",
                                         header->caplen, header->len));
    if (header->len == 0 || header->len > largest_frame_bytes)
        throw RecordingError(where(here) + "it has " + std::to_string(header->len) + " bytes, not 1 to " +
                             std::to_string(largest_frame_bytes));
    if (header->ts.tv_sec < 0 || header->ts.tv_sec > latest_s || header->ts.tv_usec < 0 ||
        header->ts.tv_usec >= 1'000'000'000)
        throw RecordingError(where(here) + "its time stamp is no time before the year 2200");
    const Stamp stamp{std::chrono::seconds(header->ts.tv_sec) + std::chrono::nanoseconds(header->ts.tv_usec)};
    return Packet{here, stamp, {bytes, header->caplen}};
}

/// Whether a packet that cannot be read hides others: looks for one with a sound seal behind its beginning.
/// Works on files that a recorder wrote; those of editcap (pcapng, or of another byte order) count as torn.
bool PacketReader::is_followed_by_packets(const PacketPlace& place) const {
    std::ifstream file(file_, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(place.offset_bytes));
    std::vector<std::uint8_t> tail(packet_header_bytes + largest_packet_read_bytes);
    file.read(reinterpret_cast<char*>(tail.data()), static_cast<std::streamsize>(tail.size()));
    tail.resize(static_cast<std::size_t>(file.gcount()));
    const auto number_at = [&](std::size_t offset) {
        std::uint32_t number = 0;
        std::memcpy(&number, tail.data() + offset, sizeof number);
        return number;
    };
    int hashed = 0;
    for (std::size_t at = 1; at + packet_header_bytes < tail.size() && hashed < most_hashed; ++at) {
        const std::size_t size = number_at(at + kept_bytes_offset);
        if (size != number_at(at + whole_bytes_offset) || size < seal_bytes ||
            size > tail.size() - at - packet_header_bytes)
            continue;
        const std::span<const std::uint8_t> message = std::span(tail).subspan(at + packet_header_bytes, size);
        if (message.size() > largest_frame_bytes) continue;
        ++hashed;
        if (has_sound_seal(message)) return true;
    }
    return false;
}

PacketPlace PacketReader::place() const {
    const auto offset = ::ftello(pcap_file(input_.get()));
    return {next_number_, offset < 0 ? file_bytes_ : static_cast<std::uint64_t>(offset)};
}

void PacketReader::seek(const PacketPlace& place) {
    if (::fseeko(pcap_file(input_.get()), static_cast<off_t>(place.offset_bytes), SEEK_SET) != 0)
        throw RecordingError(where(place) + std::strerror(errno));
    next_number_ = place.number;
    is_truncated_ = false;
}

std::string PacketReader::where(const PacketPlace& place) const {
    return fmt::format("{}, packet {} at byte {}: ", file_.string(), place.number, place.offset_bytes);
}

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
