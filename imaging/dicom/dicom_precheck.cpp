#include "imaging/dicom/dicom_precheck.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "imaging/dicom/dicom_walker.h"

namespace osteomill {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t most_inflated_bytes = std::uint64_t{1} << 28U;

std::vector<std::uint8_t> inflated(Bytes bytes) {
    z_stream stream{};
    if (inflateInit2(&stream, -15) != Z_OK) throw std::bad_alloc();
    struct End {
        z_stream* stream;
        ~End() { inflateEnd(stream); }
    } const end{&stream};
    std::vector<std::uint8_t> out;
    std::array<std::uint8_t, 1u << 16> piece{};
    std::size_t taken = 0;
    for (int result = Z_OK; result != Z_STREAM_END;) {
        if (stream.avail_in == 0) {
            const std::size_t count = std::min<std::size_t>(bytes.size() - taken, 1u << 16);
            stream.next_in = const_cast<std::uint8_t*>(bytes.data() + taken);  // zlib only reads
            stream.avail_in = static_cast<unsigned>(count);
            taken += count;
        }
        stream.next_out = piece.data();
        stream.avail_out = static_cast<unsigned>(piece.size());
        result = inflate(&stream, Z_NO_FLUSH);
        const std::size_t made = piece.size() - stream.avail_out;
        if (result != Z_OK && result != Z_STREAM_END) throw DamagedDicom();
        if (out.size() + made > most_inflated_bytes)
            throw std::invalid_argument(
                "is deflated DICOM of more than 256 MiB; save it without (transfer syntax explicit little "
                "endian)");
        out.insert(out.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(made));
    }
    return out;
}

constexpr std::string_view implicit_little = "1.2.840.10008.1.2";
constexpr std::string_view implicit_of_ge = "1.2.840.113619.5.2";
constexpr std::string_view explicit_big = "1.2.840.10008.1.2.2";
constexpr std::string_view deflated = "1.2.840.10008.1.2.1.99";

DicomSyntax syntax_of(const std::string& uid) {
    return {.is_explicit = uid != implicit_little && uid != implicit_of_ge,
            .big_endian = uid == explicit_big};
}

/// A file of before 1993, without anything that says how it is coded.
std::optional<DicomScan> scan_bare(Bytes bytes, std::uint64_t file_bytes) {
    for (const bool is_explicit : {true, false}) {
        try {
            DicomWalker walker(bytes, file_bytes);
            std::size_t at = 0;
            DicomSyntax syntax{.is_explicit = is_explicit};
            if (bytes[0] == 0x02) {
                at = walker.walk_file(0, syntax, 0x0002);
                if (!walker.scan().transfer_syntax.empty()) syntax = syntax_of(walker.scan().transfer_syntax);
            }
            walker.walk_file(at, syntax, std::nullopt);
            walker.require_sound();
            return walker.scan();
        } catch (const DamagedDicom&) {
            // Then it is coded in the other way, or it is none.
        }
    }
    return std::nullopt;
}

bool has_mark(Bytes bytes) {
    constexpr std::array<std::uint8_t, 4> mark{'D', 'I', 'C', 'M'};
    return bytes.size() >= dicom_mark_bytes && std::equal(mark.begin(), mark.end(), bytes.begin() + 128);
}

using Bytes = std::span<const std::uint8_t>;

std::uint32_t big_endian_at(Bytes bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
    return value;
}

std::optional<Codestream> jpeg2000(Bytes bytes) {
    // SOC, SIZ: length, capabilities, size, offset, tiles, number of components, depth of the first.
    constexpr std::size_t most_wrapping = 4096;  // bytes of the JP2 boxes that some files have around it
    for (std::size_t at = 0; at + 43 <= std::min(bytes.size(), most_wrapping); ++at) {
        if (big_endian_at(bytes, at, 4) != 0xff4fff51) continue;
        return Codestream{.columns = big_endian_at(bytes, at + 8, 4) - big_endian_at(bytes, at + 16, 4),
                          .rows = big_endian_at(bytes, at + 12, 4) - big_endian_at(bytes, at + 20, 4),
                          .components = big_endian_at(bytes, at + 40, 2),
                          .is_signed = (bytes[at + 42] & 0x80U) != 0};
    }
    return std::nullopt;
}

std::optional<Codestream> jpeg(Bytes bytes) {
    std::size_t at = 2;
    while (at + 10 <= bytes.size()) {
        if (bytes[at] != 0xff) return std::nullopt;
        const std::uint8_t marker = bytes[at + 1];
        if (marker == 0xff) {
            ++at;
            continue;
        }
        const bool is_frame =
            (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) ||
            marker == 0xf7;
        if (is_frame)
            return Codestream{.columns = big_endian_at(bytes, at + 7, 2),
                              .rows = big_endian_at(bytes, at + 5, 2),
                              .components = bytes[at + 9]};
        at += 2 + big_endian_at(bytes, at + 2, 2);
    }
    return std::nullopt;
}

}  // namespace

bool may_be_dicom(Bytes bytes) {
    return has_mark(bytes) ||
           (bytes.size() >= 8 && (bytes[0] == 0x02 || bytes[0] == 0x08) && bytes[1] == 0 && bytes[3] == 0);
}

std::optional<DicomScan> scan_dicom(Bytes bytes, std::uint64_t file_bytes) {
    if (!may_be_dicom(bytes)) return std::nullopt;
    if (!has_mark(bytes)) return scan_bare(bytes, file_bytes);
    DicomWalker walker(bytes, file_bytes);
    const std::size_t body = walker.walk_file(dicom_mark_bytes, {}, 0x0002);
    const std::string uid = walker.scan().transfer_syntax;
    if (uid == deflated) {
        const std::vector<std::uint8_t> plain = inflated(bytes.subspan(body));
        DicomWalker inner(plain, plain.size());
        inner.walk_file(0, {}, std::nullopt);
        inner.require_sound();
        DicomScan scan = inner.scan();
        scan.transfer_syntax = uid;
        return scan;
    }
    walker.walk_file(body, syntax_of(uid), std::nullopt);
    walker.require_sound();
    return walker.scan();
}

std::optional<Codestream> codestream_of(Bytes bytes) {
    if (bytes.size() >= 4 && bytes[0] == 0xff && bytes[1] == 0xd8) return jpeg(bytes);
    return jpeg2000(bytes);
}

}  // namespace osteomill
