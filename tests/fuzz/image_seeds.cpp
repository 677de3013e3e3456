#include "tests/fuzz/image_seeds.h"

#include <cmath>
#include <limits>

#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"

namespace osteomill::fuzz {

namespace {

using namespace testing;

void write_nrrd(const std::filesystem::path& folder) {
    write_bytes(folder / "sound", nrrd_header() + std::string(8, '\0'));
    write_bytes(folder / "pattern", nrrd_header("data file: s%03d.raw 1 5 1\n"));
    write_bytes(folder / "list", nrrd_header("data file: LIST 2\na.raw\nb.raw\nc.raw\n"));
    write_bytes(folder / "format", nrrd_header("data file: s%s%n%d.raw 1 5 1\n"));
    write_bytes(folder / "far", with(nrrd_header(), "(1,2,3)", "(1e308,nan,-inf)"));
    write_bytes(folder / "tiny", with(nrrd_header(), "(1,0,0)", "( 1e-9 , 0,0)"));
    write_bytes(folder / "large", with(nrrd_header("byte skip: -1\nline skip: 9\n"), "3 4 5",
                                       "18446744073709551615 65535 65535"));
    write_bytes(folder / "twice", nrrd_header("datafile: x\ndata file: y\nkey:=value\n# more\n"));
    write_bytes(folder / "gzip", with(with(nrrd_header("spacings: 1 nan 2\n"), "raw", "gzip"), "int16",
                                      "unsigned long long int"));
    write_bytes(folder / "units", with(nrrd_header("space units: \"um\" \"\xc2\xb5m\" \"m\"\n"),
                                       "left-posterior-superior", "LAST"));
    write_bytes(folder / "layers",
                with(with(with(nrrd_header("kinds: list domain domain domain\nSegment0_Name:=a\\nb\n"),
                               "dimension: 3", "dimension: 4"),
                          "3 4 5", "2 3 4 5"),
                     "(1,0,0)", "none (1,0.005,0)"));
}

void write_meta_image(const std::filesystem::path& folder) {
    write_bytes(folder / "sound", meta_header() + std::string(8, '\0'));
    write_bytes(folder / "matrix", meta_header("x.raw",
                                               "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                                               "HeaderSize = -1\nCenterOfRotation = 0 0 0\n"));
    write_bytes(folder / "pattern", meta_header("s%03d.raw 1 5 1"));
    write_bytes(folder / "list", meta_header("LIST\na\nb\nc\nd\ne"));
    write_bytes(folder / "string", meta_header("%s %n %9999999d"));
    write_bytes(folder / "dimensions", with(meta_header(), "NDims = 3", "NDims = -1"));
    write_bytes(folder / "far", with(meta_header(), "1 2 3", "1e308 nan -1e308"));
    write_bytes(folder / "tiny", with(meta_header(), "1 1 2", "1e-9 0 inf"));
    write_bytes(folder / "above", meta_header("../../etc/passwd", "CompressedData = True\n"));
    write_bytes(folder / "fourth",
                with(with(with(with(meta_header("LOCAL", "DistanceUnits = um\n"), "NDims = 3", "NDims = 4"),
                               "3 4 5", "3 4 5 1"),
                          "1 1 2", "1 1 2 1"),
                     "1 2 3", "1 2 3 0"));
}

void write_nifti(const std::filesystem::path& folder) {
    const auto spoiled = [](std::size_t offset, auto value) {
        std::string bytes = nifti(8);
        put(bytes, offset, value);
        return bytes;
    };
    write_bytes(folder / "sound", nifti(8));
    write_bytes(folder / "second", nifti2().substr(0, 560));
    write_bytes(folder / "sform_of_nan", spoiled(280, std::numeric_limits<float>::quiet_NaN()));
    write_bytes(folder / "negative_offset", spoiled(108, -352.0F));
    write_bytes(folder / "far", spoiled(292, 1e30F));
    write_bytes(folder / "tiny", spoiled(80, 1e-9F));
    write_bytes(folder / "dimensions", spoiled(40, std::int16_t{-1}));
    write_bytes(folder / "large", spoiled(42, std::array<std::int16_t, 3>{32767, 32767, 32767}));
    write_bytes(folder / "pair", with(nifti(8), "n+1", "ni1"));
    std::string both = spoiled(252, std::int16_t{1});
    put(both, 123, std::uint8_t{3});
    put(both, 256, std::array{0.1F, 0.2F, 0.3F, 10.0F, 20.0F, 30.0F});
    write_bytes(folder / "both_forms", both);
    write_bytes(folder / "dimensions_of_none", spoiled(40, std::array<std::int16_t, 6>{5, 3, 4, 5, 0, 0}));
}

void write_dicom(const std::filesystem::path& folder) {
    RawSlice slice;
    write_bytes(folder / "sound", raw_dicom(slice));
    write_bytes(folder / "cut", raw_dicom(slice).substr(0, 200));
    slice.before_image = nested_sequences(70);
    write_bytes(folder / "nested", raw_dicom(slice));
    slice.before_image = dicom_element(0x0021, 0x1001, "UN", nested_sequences(5)) +
                         dicom_element(0x0040, 0xa730, "SQ", dicom_item(dicom_number(0x0028, 0x0010, 7)));
    write_bytes(folder / "hidden", raw_dicom(slice));
    slice = {};
    slice.bits = 1;
    write_bytes(folder / "one_bit", raw_dicom(slice));
    slice = {};
    slice.rows = slice.columns = 46'000;
    write_bytes(folder / "gigabytes", raw_dicom(slice));
    slice = {};
    slice.sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
    slice.modality = "SEG";
    write_bytes(folder / "segmentation", raw_dicom(slice));
    slice = {};
    slice.transfer_syntax = jpeg2000_lossless;
    slice.is_encapsulated = true;
    slice.pixels = jpeg2000_start(4, 3, false) + std::string(20, '\0');
    write_bytes(folder / "jpeg2000", raw_dicom(slice));
    slice.pixels =
        std::string("\xff\xd8\xff\xe0\x00\x04xx\xff\xc3\x00\x0b\x10\x00\x03\x00\x04\x01\x01\x11\x00", 21);
    write_bytes(folder / "jpeg", raw_dicom(slice));
    constexpr int raw_deflate = -15;
    write_bytes(folder / "deflated",
                dicom_start("1.2.840.10008.1.2.1.99") +
                    deflated(dicom_number(0x0028, 0x0010, 3) + dicom_number(0x0028, 0x0011, 4), raw_deflate));
    write_bytes(folder / "implicit", dicom_start(implicit_little_endian) + dicom_tag(0x0028, 0x0010) +
                                         little(2, 4) + little(3, 2) + dicom_tag(0x0040, 0xa730) +
                                         little(0xffffffff, 4) + dicom_open_item + dicom_item_end +
                                         dicom_sequence_end);
    write_bytes(folder / "bare", dicom_element(0x0008, 0x0060, "CS", "CT") + dicom_number(0x0028, 0x0010, 3));
}

/// See dicom_segmentation.cpp for the meaning of each byte.
void write_segmentations(const std::filesystem::path& folder) {
    // Two frames of 4 x 3 pixels, of segments 1 and 2, at z = 0 and 1 mm, half a millimetre a pixel.
    const auto seed = [](char bits, const std::string& pixels) {
        const auto mm = [](double value) { return static_cast<char>(std::lround(value / 0.25) + 128); };
        const std::string frames{mm(1), mm(2), mm(0), 1, 0, mm(1), mm(2), mm(1), 2, 0};
        return std::string{1, bits, 3, 4, 2, 1, 7} + frames + std::string{2, 1, 1, 2, 1, 0, 0, char(255)} +
               std::string{mm(1), mm(1), mm(0.5), mm(0.5)} + pixels;
    };
    write_bytes(folder / "of_bits", seed(0, "\x31\x02\x07"));
    write_bytes(folder / "of_bytes", seed(1, std::string(24, '\1')));
    write_bytes(folder / "of_words", seed(2, std::string(48, '\1')));
    write_bytes(folder / "without_pixels", seed(1, ""));
}

}  // namespace

void write_image_seeds(const std::filesystem::path& folder) {
    write_segmentations(folder / "dicom_segmentation");
    write_nrrd(folder / "nrrd_header");
    write_meta_image(folder / "meta_image_header");
    write_nifti(folder / "nifti_header");
    write_dicom(folder / "dicom_header");
}

}  // namespace osteomill::fuzz
