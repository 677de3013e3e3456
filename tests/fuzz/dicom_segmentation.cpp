// Segmentations that are well-formed DICOM with values that no segmentation should have: sizes, frames,
// places, segments and pixels are the input's. The target dicom_header covers damaged DICOM, which GDCM never
// gets.
#include "imaging/dicom/dicom_segmentation.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "imaging/formats/plausible_geometry.h"
#include "tests/fuzz/targets.h"
#include "tests/support/raw_dicom.h"

namespace osteomill::fuzz {

namespace {

using namespace testing;

/// The input, byte by byte; zeros behind its end.
class Taker {
  public:
    explicit Taker(Bytes input) : left_(input) {}
    unsigned byte() {
        if (left_.empty()) return 0;
        const unsigned value = left_.front();
        left_ = left_.subspan(1);
        return value;
    }
    unsigned below(unsigned end) { return byte() % end; }
    /// Numbers as DICOM writes them, and texts that are no numbers.
    std::string number() {
        constexpr std::array<const char*, 8> odd{"nan", "inf", "1e308", "-1e30", "", "x", "1e-9", "0"};
        const unsigned kind = byte();
        return kind < odd.size() ? odd[kind] : std::to_string((static_cast<int>(kind) - 128) * 0.25);
    }
    std::string numbers(int count) {
        std::string all = number();
        for (int i = 1; i < count; ++i) all.append("\\").append(number());
        return all;
    }
    std::string rest() const { return {left_.begin(), left_.end()}; }

  private:
    Bytes left_;
};

std::string group(std::uint32_t element, const std::string& content) {
    return dicom_element(element >> 16U, element & 0xffffU, "SQ", dicom_item(content));
}

std::string segmentation(Taker take) {
    constexpr std::array<std::uint32_t, 5> bits{1, 8, 16, 0, 32};
    RawSlice file;
    file.sop_class = take.below(4) == 0 ? "1.2.840.10008.5.1.4.1.1.66.7" : "1.2.840.10008.5.1.4.1.1.66.4";
    file.modality = "SEG";
    file.bits = bits[take.below(bits.size())];
    file.pixel_representation = 0;
    file.rows = take.below(8);
    file.columns = take.below(8);
    const unsigned frames = take.below(12);
    file.frames = take.below(8) == 0 ? take.number() : std::to_string(frames);
    const unsigned has = take.byte();  // which of the groups are there
    std::string per_frame, segments;
    for (unsigned i = 0; i < frames; ++i) {
        std::string item;
        if ((has & 1U) != 0) item += group(0x00209113, dicom_element(0x0020, 0x0032, "DS", take.numbers(3)));
        const unsigned segment = take.byte();
        const unsigned shift = take.below(9);
        if ((has & 2U) != 0) item += group(0x0062000a, dicom_number(0x0062, 0x000b, segment << shift));
        per_frame += dicom_item(item);
    }
    for (unsigned i = take.below(4); i > 0; --i) {
        const unsigned number = take.byte();
        segments += dicom_item(dicom_number(0x0062, 0x0004, number) +
                               dicom_element(0x0062, 0x0005, "LO", std::string(take.below(4), 'n')));
    }
    const std::string orientation = take.below(2) == 0 ? "1\\0\\0\\0\\1\\0" : take.numbers(6);
    const std::string type = take.below(2) == 0 ? "BINARY" : "FRACTIONAL";
    const unsigned most = take.byte();
    const std::string thickness = take.number();
    const std::string gap = take.number();
    const std::string spacing = take.numbers(2);
    file.after_image =
        dicom_element(0x0062, 0x0001, "CS", type) + dicom_element(0x0062, 0x0002, "SQ", segments) +
        dicom_number(0x0062, 0x000e, most) +
        dicom_element(0x5200, 0x9229, "SQ",
                      dicom_item(group(0x00289110, dicom_element(0x0018, 0x0050, "DS", thickness) +
                                                       dicom_element(0x0018, 0x0088, "DS", gap) +
                                                       dicom_element(0x0028, 0x0030, "DS", spacing)) +
                                 group(0x00209116, dicom_element(0x0020, 0x0037, "DS", orientation)))) +
        ((has & 4U) != 0 ? dicom_element(0x5200, 0x9230, "SQ", per_frame) : "");
    file.pixels = take.rest();
    if (file.pixels.size() % 2 != 0) file.pixels += '\0';
    return raw_dicom(file);
}

/// A file in memory.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& bytes) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
        if (::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("no memory for a file");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

}  // namespace

void dicom_segmentation(Bytes input) {
    const MemoryFile file(segmentation(Taker(input)));
    try {
        const OpenedImage opened = open_dicom_segmentation(file.path());
        require_plausible_geometry(opened.image);
        require(opened.layers >= 1 && opened.layers <= 255, "no layer, or too many");
        int slices = 0;
        opened.read_slices(
            [&](int k, std::span<float> slice) {
                require(k == slices++, "slices out of their order");
                require(slice.size() * static_cast<std::size_t>(opened.image.size_voxels.z) ==
                            voxel_count(opened.image) * static_cast<std::size_t>(opened.layers),
                        "a slice of another size");
                require(std::ranges::all_of(slice,
                                            [](float label) { return label >= 0.0F && label <= 65535.0F; }),
                        "labels that are none");
            },
            [](double) {});
        require(slices == opened.image.size_voxels.z, "slices are missing");
    } catch (const std::runtime_error& error) {
        const std::string line = error.what();
        require(line.starts_with(file.path() + ": ") && line.find('\n') == std::string::npos,
                "a complaint of no file, or of several lines: " + line);
    }
}

}  // namespace osteomill::fuzz
