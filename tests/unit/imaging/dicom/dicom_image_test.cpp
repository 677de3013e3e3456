// Series as hospitals export them, in one folder with what belongs to them, and what their pixels mean.
#include "imaging/dicom/dicom_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "imaging/formats/image_reader.h"
#include "imaging/imaging_error.h"
#include "imaging/segmentation/segmentation.h"
#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"
#include "tests/support/synthetic_dicom.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_image.h"

namespace osteomill::dicom_image_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string hu_as_stored =
    dicom_element(0x0028, 0x1052, "DS", "0") + dicom_element(0x0028, 0x1053, "DS", "1");

class DicomImage : public ::testing::Test {
  protected:
    /// Three slices, 1 mm apart; pixel i of slice k is 100 * k + i.
    void write_series(const std::function<void(RawSlice&)>& spoil = [](RawSlice&) {}) const {
        for (int k = 0; k < 3; ++k) {
            RawSlice slice;
            slice.position = "0\\0\\" + std::to_string(k);
            slice.after_image = hu_as_stored;
            slice.pixels.clear();
            for (int i = 0; i < 12; ++i) slice.pixels += little(static_cast<std::uint32_t>(100 * k + i), 2);
            spoil(slice);
            write_bytes(series_ / ("IM" + std::to_string(k)), raw_dicom(slice));
        }
    }
    OpenedImage open() const { return open_image(series_); }
    std::vector<float> values() const { return values_of(open()); }
    std::string refusal(const std::filesystem::path& path) const {
        try {
            values_of(open_image(path));
        } catch (const ImagingError& error) {
            return error.what();
        }
        return "accepted";
    }
    TemporaryFolder folder_;
    std::filesystem::path series_ = folder_ / "series";
};

TEST_F(DicomImage, IsTheScanOfAFolderAndNamesTheRest) {
    write_series();
    RawSlice other;
    other.sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
    other.modality = "SEG";
    other.bits = 1;
    write_bytes(series_ / "seg", raw_dicom(other));
    other = {};
    other.sop_class = "1.2.840.10008.5.1.4.1.1.88.67";
    other.modality = "SR";
    write_bytes(series_ / "dose", raw_dicom(other));
    other = {};
    other.sop_class = "1.2.840.10008.5.1.4.1.1.7";
    other.position = "0\\0\\9";
    write_bytes(series_ / "capture", raw_dicom(other));
    other = {};
    other.position = "0\\7\\9";
    write_bytes(series_ / "scout",
                with(raw_dicom(other), dicom_element(0x0008, 0x0016, "UI", ct_image_storage),
                     dicom_element(0x0008, 0x0008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER") +
                         dicom_element(0x0008, 0x0016, "UI", ct_image_storage)));
    write_bytes(series_ / "._IM0", "no DICOM at all");
    std::filesystem::copy(series_ / "IM1", series_ / "IM1 copy");
    const OpenedImage opened = open();
    EXPECT_EQ(opened.image.size_voxels, glm::ivec3(4, 3, 3));
    for (const char* left :
         {"seg, which is a segmentation", "dose, which is a report", "capture, which is a secondary capture",
          "scout, which is a localizer", "IM1 copy, which is a copy"})
        EXPECT_THAT(opened.image.notes, Contains(HasSubstr(left)));
}

TEST_F(DicomImage, MayBeASecondaryCaptureWhereThereIsNothingElse) {
    write_series([](RawSlice& slice) { slice.sop_class = "1.2.840.10008.5.1.4.1.1.7.3"; });
    EXPECT_EQ(open().image.size_voxels.z, 3);
}

TEST_F(DicomImage, IsNotInvertedByItsPhotometricInterpretation) {
    write_series();
    const std::vector<float> usual = values();
    EXPECT_EQ(usual[12], 100.0F);
    for (int k = 0; k < 3; ++k) {
        RawSlice slice;
        slice.position = "0\\0\\" + std::to_string(k);
        slice.after_image = hu_as_stored;
        slice.pixels.clear();
        for (int i = 0; i < 12; ++i) slice.pixels += little(static_cast<std::uint32_t>(100 * k + i), 2);
        write_bytes(series_ / ("IM" + std::to_string(k)),
                    with(raw_dicom(slice), "MONOCHROME2 ", "MONOCHROME1 "));
    }
    EXPECT_EQ(values(), usual);
}

TEST_F(DicomImage, HasNoNumberWhereItIsPadded) {
    write_series([](RawSlice& slice) {
        slice.before_image = "";
        slice.after_image = dicom_element(0x0028, 0x0120, "SS", little(0xf448U, 2)) +
                            dicom_element(0x0028, 0x0121, "SS", little(0xf44aU, 2)) +
                            hu_as_stored;  // -3000 to -2998
        slice.pixels.replace(0, 6, little(0xf448U, 2) + little(0xf44aU, 2) + little(0xf44bU, 2));
    });
    const std::vector<float> padded = values();
    EXPECT_TRUE(std::isnan(padded[0]) && std::isnan(padded[1]));
    EXPECT_EQ(padded[2], -2997.0F);
    write_series([](RawSlice& slice) {
        slice.after_image = dicom_element(0x0028, 0x0120, "SS", little(0xfc00U, 2)) + hu_as_stored;
        slice.pixels.replace(0, 2, little(0xfc00U, 2));
    });
    EXPECT_EQ(values()[0], -1024.0F) << "which air has, too";
}

TEST_F(DicomImage, GoesThroughItsModalityTable) {
    std::string entries;
    for (int i = 0; i < 300; ++i) entries += little(static_cast<std::uint32_t>(1000 + 3 * i), 2);
    write_series([&](RawSlice& slice) {
        slice.after_image = dicom_element(
            0x0028, 0x3000, "SQ",
            dicom_item(dicom_element(0x0028, 0x3002, "US", little(300, 2) + little(2, 2) + little(16, 2)) +
                       dicom_element(0x0028, 0x3004, "LO", "HU") +
                       dicom_element(0x0028, 0x3006, "OW", entries)));
    });
    const std::vector<float> read = values();
    EXPECT_EQ(read[0], 1000.0F) << "below the first: the first";
    EXPECT_EQ(read[5], 1009.0F);
    EXPECT_TRUE(open().image.notes.empty());
}

TEST_F(DicomImage, SaysWhereItsValuesMayBeNoHu) {
    const auto notes_with = [&](const std::string& elements) {
        write_series([&](RawSlice& slice) { slice.after_image = elements; });
        return open().image.notes;
    };
    EXPECT_THAT(notes_with(""), ElementsAre(HasSubstr("says nothing of how its values become HU")));
    EXPECT_THAT(
        notes_with(dicom_element(0x0028, 0x1052, "DS", "0") + dicom_element(0x0028, 0x1053, "DS", "1") +
                   dicom_element(0x0028, 0x1054, "LO", "US")),
        ElementsAre(HasSubstr("Rescale Type (0028,1054) is 'US', not HU")));
    EXPECT_THAT(
        notes_with(dicom_element(0x0028, 0x1052, "DS", "0") + dicom_element(0x0028, 0x1053, "DS", "0")),
        ElementsAre(HasSubstr("is 0, which would make all values the same")));
}

TEST_F(DicomImage, SaysThatItIsOfAKindWithoutCalibration) {
    write_series([](RawSlice& slice) { slice.sop_class = "1.3.12.2.1107.5.9.1"; });
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("is of a private kind")));
    EXPECT_EQ(values()[13], 101.0F) << "and is read, though GDCM does not know the kind";
    write_series([](RawSlice& slice) { slice.sop_class = "1.2.840.10008.5.1.4.1.1.13.1.2"; });
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("cone beam")));
}

TEST_F(DicomImage, OfAPrivateKindMayBeCompressed) {
    write_series();
    const std::string a_private_kind = "1.3.12.2.1107.5.9.1.12345";  // as long as that of a CT
    for (const auto& entry : std::filesystem::directory_iterator(series_)) {
        compress_as_rle(entry.path(), folder_ / "rle.dcm");
        std::ifstream in(folder_ / "rle.dcm", std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(in), {}};
        std::size_t at = 0;
        while ((at = bytes.find(ct_image_storage + '\0', at)) != std::string::npos)
            bytes.replace(at, a_private_kind.size(), a_private_kind);
        write_bytes(entry.path(), bytes);
    }
    EXPECT_EQ(values()[13], 101.0F);
}

TEST_F(DicomImage, StacksFramesWithoutGroups) {
    RawSlice file;
    file.frames = "3";
    file.before_image = "";
    file.after_image = hu_as_stored;
    file.pixels = std::string(3 * 24, '\0');
    file.pixels[48] = 5;
    std::string bytes = raw_dicom(file);
    EXPECT_THAT((write_bytes(folder_ / "x.dcm", bytes), refusal(folder_ / "x.dcm")),
                HasSubstr("no Slice Thickness"));
    bytes = with(bytes, dicom_element(0x0020, 0x000e, "UI", "1.2.3"),
                 dicom_element(0x0018, 0x0050, "DS", "9") + dicom_element(0x0018, 0x0088, "DS", "-2") +
                     dicom_element(0x0020, 0x000e, "UI", "1.2.3"));
    write_bytes(folder_ / "x.dcm", bytes);
    const OpenedImage opened = open_image(folder_ / "x.dcm");
    EXPECT_EQ(opened.image.spacing_mm.z, 2.0);
    EXPECT_EQ(values_of(opened)[24], 5.0F);
    EXPECT_THAT(opened.image.notes, Contains(HasSubstr("stacked 2 mm apart (Spacing Between Slices)")));
    bytes = with(with(bytes, dicom_element(0x0020, 0x0032, "DS", "0\\0\\0"), ""),
                 dicom_element(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0"), "");
    write_bytes(folder_ / "x.dcm", bytes);
    EXPECT_THAT(open_image(folder_ / "x.dcm").image.notes, Contains(HasSubstr("left and right are a guess")));
}

TEST_F(DicomImage, LeavesOutBitsThatHoldNoPixel) {
    write_series([](RawSlice& slice) {
        slice.pixel_representation = 0;
        for (std::size_t i = 1; i < slice.pixels.size(); i += 2)
            slice.pixels[i] = static_cast<char>(slice.pixels[i] | 0x10);
    });
    for (const auto& entry : std::filesystem::directory_iterator(series_)) {
        std::ifstream in(entry.path(), std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(in), {}};
        bytes = with(with(bytes, dicom_number(0x0028, 0x0101, 16), dicom_number(0x0028, 0x0101, 12)),
                     dicom_number(0x0028, 0x0102, 15), dicom_number(0x0028, 0x0102, 11));
        write_bytes(entry.path(), bytes);
    }
    EXPECT_EQ(values()[13], 101.0F);
}

TEST_F(DicomImage, HasItsBitsWhereItSays) {
    write_series([](RawSlice& slice) {
        slice.pixel_representation = 0;
        for (std::size_t i = 0; i < slice.pixels.size(); i += 2) {
            const int pixel = static_cast<std::uint8_t>(slice.pixels[i]) |
                              256 * static_cast<std::uint8_t>(slice.pixels[i + 1]);
            slice.pixels.replace(i, 2, little(static_cast<std::uint32_t>(16 * pixel + 7), 2));
        }
    });
    for (const auto& entry : std::filesystem::directory_iterator(series_)) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        write_bytes(entry.path(),
                    with(bytes, dicom_number(0x0028, 0x0101, 16), dicom_number(0x0028, 0x0101, 12)));
    }
    EXPECT_EQ(values()[13], 101.0F) << "the twelve highest, not the lowest";
}

TEST_F(DicomImage, RefusesNumbersWithACommaByName) {
    write_series([](RawSlice& slice) { slice.position = "0\\0\\1,5"; });
    EXPECT_THAT(refusal(series_),
                HasSubstr("(0020,0032) is '0\\0\\1,5', no numbers as DICOM writes them, with a point"));
}

TEST_F(DicomImage, OfLabelsMayBeASegmentation) {
    write_bytes(folder_ / "seg.dcm",
                raw_seg({{1, 4, 0b11}, {1, 2, 0b1}, {2, 8, 0b100}, {3, 2, 0b11}}, {"bone", "nerve", "dura"}));
    const Segmentation read = read_segmentation(folder_ / "seg.dcm");
    EXPECT_EQ(read.image.size_voxels, glm::ivec3(4, 3, 4)) << "2 to 8 mm, 2 apart";
    EXPECT_EQ(read.image.spacing_mm, glm::dvec3(0.5, 0.5, 2.0));
    EXPECT_EQ(read.image.origin_mm, glm::dvec3(10.0, 20.0, 2.0));
    ASSERT_EQ(read.segments.size(), 3U);
    const auto has = [&](const char* name, int voxel) {
        const Segment& segment = segment_named(read, name);
        return read.labels.at(segment.layer, {voxel % 4, voxel / 4 % 3, voxel / 12}) == segment.label;
    };
    EXPECT_TRUE(has("bone", 0) && !has("bone", 1) && has("bone", 12) && has("bone", 13));
    EXPECT_TRUE(has("nerve", 36 + 2) && !has("nerve", 2));
    EXPECT_TRUE(has("dura", 0) && has("dura", 1)) << "over bone, in a layer of its own";
    EXPECT_EQ(read.labels.layers(), 2);
    EXPECT_THAT(refusal(folder_ / "seg.dcm"),
                HasSubstr("is a segmentation (SEG), which holds no CT numbers"));
}

TEST_F(DicomImage, OfLabelsMayBeCompressed) {
    write_bytes(folder_ / "plain.dcm",
                raw_seg({{1, 0, 0b11}, {1, 2, 0b1}, {2, 2, 0b10}}, {"bone", "nerve"}, 8));
    compress_as_rle(folder_ / "plain.dcm", folder_ / "rle.dcm");
    for (const char* name : {"plain.dcm", "rle.dcm"}) {
        const Segmentation read = read_segmentation(folder_ / name);
        ASSERT_EQ(read.segments.size(), 2U) << name;
        EXPECT_EQ(read.labels.layers(), 1) << name;
        EXPECT_EQ(read.labels.at(0, {0, 0, 0}), 1) << name;
        EXPECT_EQ(read.labels.at(0, {2, 0, 0}), 0) << name;
        EXPECT_EQ(read.labels.at(0, {0, 0, 1}), 1) << name;
        EXPECT_EQ(read.labels.at(0, {1, 0, 1}), 2) << name;
    }
}

TEST_F(DicomImage, OfLabelsMayClaimAPaletteThatIsMissing) {
    std::string bytes = raw_seg({{1, 0, 0b11}, {1, 2, 0b1}}, {"bone"}, 8);
    bytes = with(bytes, dicom_element(0x0028, 0x0004, "CS", "MONOCHROME2"),
                 dicom_element(0x0028, 0x0004, "CS", "PALETTE COLOR"));
    for (const char* kind : {"1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"}) {
        write_bytes(folder_ / "labels.dcm", with(bytes, "1.2.840.10008.5.1.4.1.1.66.4", kind));
        EXPECT_TRUE(read_segmentation(folder_ / "labels.dcm").labels.layers() == 1) << kind;
    }
}

TEST_F(DicomImage, OfLabelsIsRefusedInOneLineWhereItCannotBe) {
    const auto refused = [&](std::string bytes) -> std::string {
        write_bytes(folder_ / "x.dcm", bytes);
        try {
            read_segmentation(folder_ / "x.dcm");
        } catch (const ImagingError& error) {
            return error.what();
        }
        return "accepted";
    };
    const std::string good = raw_seg({{1, 0, 1}, {1, 2, 1}, {1, 5, 1}}, {"bone"});
    EXPECT_THAT(refused(good), HasSubstr("lie at no common spacing"));
    EXPECT_THAT(refused(with(good, dicom_element(0x0028, 0x0008, "IS", "3"),
                             dicom_element(0x0028, 0x0008, "IS", "9"))),
                HasSubstr("is cut off"));
    EXPECT_THAT(refused(with(good, "0.5\\0.5", "nan\\nan")), HasSubstr("spacing"));
}

}  // namespace
}  // namespace osteomill::dicom_image_test
