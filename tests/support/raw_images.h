// Images as bytes, for tests that spoil one thing of them: 3 x 4 x 5 int16 voxels of 0.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace osteomill::testing {

inline constexpr std::size_t raw_image_bytes = 3 * 4 * 5 * 2;

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream out(path, std::ios::binary);
    out << bytes;
    if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// `text` with the first `from` in it replaced; throws if there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("no '" + from + "' to replace");
    return text.replace(at, from.size(), to);
}

/// The header of a NRRD, up to and with its blank line.
inline std::string nrrd_header(const std::string& more = "") {
    return "NRRD0005\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 4 5\n"
           "space directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\nencoding: raw\n"
           "endian: little\n" +
           more + "\n";
}

/// The header of a MetaImage.
inline std::string meta_header(const std::string& data_file = "LOCAL", const std::string& more = "") {
    return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" + more +
           "Offset = 1 2 3\nElementSpacing = 1 1 2\nDimSize = 3 4 5\nElementType = MET_SHORT\n"
           "ElementDataFile = " +
           data_file + "\n";
}

template <typename Value>
void put(std::string& bytes, std::size_t offset, const Value& value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// NIfTI-1, one file, 352 bytes of header.
inline std::string nifti(std::size_t voxel_bytes = raw_image_bytes) {
    std::string file(352 + voxel_bytes, '\0');
    put(file, 0, std::int32_t{348});
    put(file, 40, std::array<std::int16_t, 8>{3, 3, 4, 5, 1, 1, 1, 1});
    put(file, 70, std::int16_t{4});
    put(file, 72, std::int16_t{16});
    put(file, 76, std::array{1.0F, 2.0F, 2.0F, 2.0F});
    put(file, 108, 352.0F);
    put(file, 254, std::int16_t{1});  // orientation from the rows below, RAS
    put(file, 280, std::array{2.0F, 0.0F, 0.0F, 10.0F, 0.0F, 2.0F, 0.0F, 20.0F, 0.0F, 0.0F, 2.0F, 30.0F});
    put(file, 344, std::array{'n', '+', '1', '\0'});
    return file;
}

/// NIfTI-2 of the same image.
inline std::string nifti2() {
    std::string file(544 + raw_image_bytes, '\0');
    put(file, 0, std::int32_t{540});
    put(file, 4, std::array{'n', '+', '2', '\0', '\r', '\n', '\032', '\n'});
    put(file, 12, std::int16_t{4});
    put(file, 14, std::int16_t{16});
    put(file, 16, std::array<std::int64_t, 8>{3, 3, 4, 5, 1, 1, 1, 1});
    put(file, 104, std::array{1.0, 2.0, 2.0, 2.0});
    put(file, 168, std::int64_t{544});
    put(file, 348, std::int32_t{1});
    put(file, 400, std::array{2.0, 0.0, 0.0, 10.0, 0.0, 2.0, 0.0, 20.0, 0.0, 0.0, 2.0, 30.0});
    return file;
}

/// Compressed: a gzip member (`window` 31), or a zlib stream (15).
inline std::string deflated(const std::string& bytes, int window = 31) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("no zlib");
    std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<unsigned>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<unsigned>(out.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("zlib failed");
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

}  // namespace osteomill::testing
