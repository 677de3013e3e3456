// DICOM as bytes, element by element, for tests that need files that no library writes.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace osteomill::testing {

inline std::string little(std::uint32_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xffU);
    return out;
}

inline std::string dicom_tag(std::uint32_t group, std::uint32_t element) {
    return little(group, 2) + little(element, 2);
}

/// Explicit, little endian. `length` replaces the value's own length, to make a wrong one.
inline std::string dicom_element(std::uint32_t group, std::uint32_t element,
                                 const std::string& representation, std::string value,
                                 std::int64_t length = -1) {
    if (value.size() % 2 != 0) value += representation == "UI" ? '\0' : ' ';
    const auto stated = static_cast<std::uint32_t>(length >= 0 ? length : static_cast<long>(value.size()));
    const bool is_long =
        representation == "OB" || representation == "OW" || representation == "SQ" || representation == "UN";
    return dicom_tag(group, element) + representation +
           (is_long ? std::string(2, '\0') + little(stated, 4) : little(stated, 2)) + value;
}

inline std::string dicom_number(std::uint32_t group, std::uint32_t element, std::uint32_t value) {
    return dicom_element(group, element, "US", little(value, 2));
}

inline constexpr std::int64_t undefined_dicom_length = 0xffffffff;
inline const std::string dicom_open_item = dicom_tag(0xfffe, 0xe000) + little(0xffffffff, 4);
inline const std::string dicom_item_end = dicom_tag(0xfffe, 0xe00d) + little(0, 4);
inline const std::string dicom_sequence_end = dicom_tag(0xfffe, 0xe0dd) + little(0, 4);
inline const std::string ct_image_storage = "1.2.840.10008.5.1.4.1.1.2";
inline const std::string explicit_little_endian = "1.2.840.10008.1.2.1";
inline const std::string implicit_little_endian = "1.2.840.10008.1.2";
inline const std::string jpeg2000_lossless = "1.2.840.10008.1.2.4.90";

inline std::string dicom_item(const std::string& content) {
    return dicom_tag(0xfffe, 0xe000) + little(static_cast<std::uint32_t>(content.size()), 4) + content;
}

/// Preamble and meta information.
inline std::string dicom_start(const std::string& transfer_syntax) {
    return std::string(128, '\0') + "DICM" + dicom_element(0x0002, 0x0010, "UI", transfer_syntax);
}

/// Sequences within one another, `depth` deep, without lengths.
inline std::string nested_sequences(int depth) {
    std::string open;
    std::string close;
    for (int i = 0; i < depth; ++i) {
        open += dicom_element(0x0040, 0xa730, "SQ", "", undefined_dicom_length) + dicom_open_item;
        close += dicom_item_end + dicom_sequence_end;
    }
    return open + close;
}

/// The statements of a raw CT slice of 4 x 3 pixels; each may be spoiled.
struct RawSlice {
    std::string transfer_syntax = explicit_little_endian;
    std::string sop_class = ct_image_storage;
    std::string modality = "CT";
    std::string before_image{};  ///< elements between groups 0020 and 0028
    std::string after_image{};   ///< elements between group 0028 and the pixels
    std::uint32_t rows = 3;
    std::uint32_t columns = 4;
    std::uint32_t bits = 16;
    std::uint32_t pixel_representation = 1;
    std::string position = "0\\0\\0";
    std::string spacing = "1\\1";
    std::string frames{};  ///< Number of Frames, if not empty
    std::string pixels = std::string(24, '\0');
    std::int64_t pixel_bytes = -1;  ///< stated instead of the pixels' own, if not below 0
    bool is_encapsulated = false;   ///< the pixels are one fragment
};

inline std::string raw_dicom(const RawSlice& slice) {
    std::string file =
        dicom_start(slice.transfer_syntax) + dicom_element(0x0008, 0x0016, "UI", slice.sop_class) +
        dicom_element(0x0008, 0x0018, "UI", "1.2.3.4") + dicom_element(0x0008, 0x0060, "CS", slice.modality) +
        dicom_element(0x0020, 0x000e, "UI", "1.2.3") + dicom_element(0x0020, 0x0032, "DS", slice.position) +
        dicom_element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0") + slice.before_image +
        dicom_number(0x0028, 0x0002, 1) + dicom_element(0x0028, 0x0004, "CS", "MONOCHROME2") +
        (slice.frames.empty() ? "" : dicom_element(0x0028, 0x0008, "IS", slice.frames)) +
        dicom_number(0x0028, 0x0010, slice.rows) + dicom_number(0x0028, 0x0011, slice.columns) +
        dicom_element(0x0028, 0x0030, "DS", slice.spacing) + dicom_number(0x0028, 0x0100, slice.bits) +
        dicom_number(0x0028, 0x0101, slice.bits) + dicom_number(0x0028, 0x0102, slice.bits - 1) +
        dicom_number(0x0028, 0x0103, slice.pixel_representation) + slice.after_image;
    if (!slice.is_encapsulated)
        return file + dicom_element(0x7fe0, 0x0010, "OW", slice.pixels, slice.pixel_bytes);
    return file + dicom_element(0x7fe0, 0x0010, "OB", "", undefined_dicom_length) + dicom_item("") +
           dicom_item(slice.pixels) + dicom_sequence_end;
}

/// A multi-frame CT, whose frames of 12 x 10 pixels lie at these z, mm, and say that HU are 2 * pixel - 1000.
inline RawSlice multi_frame(const std::vector<int>& z_mm) {
    const auto group = [](std::uint32_t element, const std::string& content) {
        return dicom_element(element >> 16U, element & 0xffffU, "SQ", dicom_item(content));
    };
    std::string frames;
    for (const int z : z_mm)
        frames +=
            dicom_item(group(0x00209113, dicom_element(0x0020, 0x0032, "DS", "0\\0\\" + std::to_string(z))) +
                       group(0x00289145, dicom_element(0x0028, 0x1052, "DS", "-1000") +
                                             dicom_element(0x0028, 0x1053, "DS", "2")));
    const std::string shared = group(0x00289110, dicom_element(0x0028, 0x0030, "DS", "1\\1")) +
                               group(0x00209116, dicom_element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0"));
    RawSlice file;
    file.sop_class = "1.2.840.10008.5.1.4.1.1.2.1";
    file.frames = std::to_string(z_mm.size());
    file.after_image =
        dicom_element(0x5200, 0x9229, "SQ", dicom_item(shared)) + dicom_element(0x5200, 0x9230, "SQ", frames);
    file.columns = 12;
    file.rows = 10;
    file.pixels = std::string(z_mm.size() * 240, '\0');
    return file;
}

/// A frame of a segmentation, 4 x 3 pixels: the segment (0: none stated), its position, and the twelve pixels
/// as bits.
struct SegFrame {
    int segment;
    double z_mm;
    unsigned bits;
};

/// A segmentation; `bits_of_pixel` is 1 or 8. `shared` also applies to all frames.
inline std::string raw_seg(const std::vector<SegFrame>& frames, const std::vector<std::string>& names,
                           std::uint32_t bits_of_pixel = 1, const std::string& shared = "") {
    const auto group = [](std::uint32_t element, const std::string& content) {
        return dicom_element(element >> 16U, element & 0xffffU, "SQ", dicom_item(content));
    };
    std::string per_frame, segments, pixels;
    for (const SegFrame& frame : frames) {
        per_frame += dicom_item(
            group(0x00209113, dicom_element(0x0020, 0x0032, "DS", fmt::format("10\\20\\{:g}", frame.z_mm))) +
            (frame.segment == 0
                 ? ""
                 : group(0x0062000a,
                         dicom_number(0x0062, 0x000b, static_cast<std::uint32_t>(frame.segment)))));
        for (unsigned i = 0; i < 12; ++i) pixels += static_cast<char>(frame.bits >> i & 1U);
    }
    std::uint32_t number = 0;
    for (const std::string& name : names)
        segments +=
            dicom_item(dicom_number(0x0062, 0x0004, ++number) + dicom_element(0x0062, 0x0005, "LO", name));
    RawSlice file;
    file.sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
    file.modality = "SEG";
    file.bits = bits_of_pixel;
    file.pixel_representation = 0;
    file.frames = std::to_string(frames.size());
    file.after_image =
        dicom_element(0x0062, 0x0001, "CS", "BINARY") + dicom_element(0x0062, 0x0002, "SQ", segments) +
        dicom_element(
            0x5200, 0x9229, "SQ",
            dicom_item(shared + group(0x00289110, dicom_element(0x0028, 0x0030, "DS", "0.5\\0.5")) +
                       group(0x00209116, dicom_element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0")))) +
        dicom_element(0x5200, 0x9230, "SQ", per_frame);
    file.pixels = pixels;
    if (bits_of_pixel == 1) {
        file.pixels = std::string((pixels.size() + 7) / 8, '\0');
        for (std::size_t i = 0; i < pixels.size(); ++i)
            file.pixels[i / 8] = static_cast<char>(file.pixels[i / 8] | pixels[i] << (i % 8));
    }
    if (file.pixels.size() % 2 != 0) file.pixels += '\0';
    return raw_dicom(file);
}

/// The start of a JPEG 2000 codestream that says this of its image: SOC and SIZ.
inline std::string jpeg2000_start(std::uint32_t columns, std::uint32_t rows, bool is_signed) {
    const auto big = [](std::uint32_t value, int bytes) {
        const std::string reversed = little(value, bytes);
        return std::string(reversed.rbegin(), reversed.rend());
    };
    return big(0xff4fff51, 4) + big(41, 2) + big(0, 2) + big(columns, 4) + big(rows, 4) + big(0, 4) +
           big(0, 4) + big(columns, 4) + big(rows, 4) + big(0, 4) + big(0, 4) + big(1, 2) +
           static_cast<char>(15 | (is_signed ? 0x80 : 0)) + "\x01\x01";
}

}  // namespace osteomill::testing
