// Series as hospitals export them, in one folder with related files, and the meaning of their pixels.
#include "imaging/dicom/dicom_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "imaging/formats/image_reader.h"
#include "imaging/imaging_error.h"
#include "imaging/segmentation/segmentation.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
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
    /// The series says that so many of the allocated bits hold a pixel, up to the highest.
    void state_bits(std::uint32_t allocated, std::uint32_t stored, std::uint32_t high) const {
        for (const auto& entry : std::filesystem::directory_iterator(series_)) {
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string bytes{std::istreambuf_iterator<char>(in), {}};
            write_bytes(
                entry.path(),
                with(bytes,
                     dicom_number(0x0028, 0x0101, allocated) + dicom_number(0x0028, 0x0102, allocated - 1),
                     dicom_number(0x0028, 0x0101, stored) + dicom_number(0x0028, 0x0102, high)));
        }
    }
    OpenedImage open() const { return open_image(series_); }
    std::vector<float> values() const { return values_of(open()); }
    std::string refusal(const std::filesystem::path& path) const {
        return testing::message_of<ImagingError>([&] { values_of(open_image(path)); });
    }
    std::string refusal_of_labels(const std::string& bytes) const {
        write_bytes(folder_ / "x.dcm", bytes);
        return testing::message_of<ImagingError>([&] { read_segmentation(folder_ / "x.dcm"); });
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

TEST_F(DicomImage, OfOneSliceSaysWhatIsBesideItAndWhyThatIsNotTaken) {
    write_series([](RawSlice& slice) { slice.sop_class = "1.2.840.10008.5.1.4.1.1.7"; });
    write_bytes(series_ / "ct",
                with(raw_dicom({.position = "0\\0\\9"}), dicom_element(0x0020, 0x000e, "UI", "1.2.3"),
                     dicom_element(0x0020, 0x000e, "UI", "1.2.5")));
    EXPECT_THAT(refusal(series_),
                HasSubstr("a single slice, which is no volume; left out 3 files such as IM0, "
                          "which is a secondary capture"));
    const auto refusal_of = [&](const std::string& uid) {
        return testing::message_of<ImagingError>([&] { open_image(series_, {.series_uid = uid}); });
    };
    EXPECT_THAT(refusal_of("1.2.3"), HasSubstr("its series 1.2.3 is left out beside the others, as it is a "
                                               "secondary capture"));
    EXPECT_THAT(refusal_of("1.2.9"), HasSubstr("holds no series 1.2.9; it holds 1.2.5 (1 slices)"));
    write_series([](RawSlice& slice) { slice.modality = "MR"; });
    EXPECT_EQ(open().image.size_voxels.z, 3) << "whatever it is, rather than a single slice of CT";
    EXPECT_THAT(open().image.notes, Contains(HasSubstr("passed over series 1.2.5 (1 slices)")));
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
    EXPECT_THAT(open_image(folder_ / "x.dcm").image.notes, Contains(HasSubstr(sides_are_a_guess)));
}

TEST_F(DicomImage, LeavesOutBitsThatHoldNoPixel) {
    write_series([](RawSlice& slice) {
        slice.pixel_representation = 0;
        for (std::size_t i = 1; i < slice.pixels.size(); i += 2)
            slice.pixels[i] = static_cast<char>(slice.pixels[i] | 0x10);
    });
    state_bits(16, 12, 11);
    EXPECT_EQ(values()[13], 101.0F);
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("bits set above the 12 that hold their values")));
}

TEST_F(DicomImage, SaysOnlyOfBitsThatAreNoSignAndNoOverlayThatTheyAreLeftOut) {
    const auto notes = [&](std::uint32_t sign, std::uint32_t pixel, const std::string& overlay) {
        write_series([&](RawSlice& slice) {
            slice.pixel_representation = sign;
            slice.pixels.replace(2, 2, little(pixel, 2));
            slice.after_image += overlay;
        });
        state_bits(16, 12, 11);
        return open().image.notes.size();
    };
    EXPECT_EQ(notes(1, 0xff00, ""), 0U) << "-256, in all bits";
    EXPECT_EQ(notes(1, 0x0f00, ""), 0U) << "-256, in twelve";
    EXPECT_EQ(notes(1, 0x1700, ""), 1U) << "5888, cut to 1792";
    EXPECT_EQ(notes(0, 0xff00, ""), 1U);
    const std::string overlay = dicom_number(0x6000, 0x0102, 12);
    EXPECT_EQ(notes(0, 0x1f00, overlay), 0U);
    EXPECT_EQ(notes(1, 0xff00, overlay), 0U);
    EXPECT_EQ(notes(1, 0xef00, overlay), 0U);
    EXPECT_EQ(notes(0, 0x2f00, overlay), 1U);
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
    state_bits(16, 12, 15);
    EXPECT_EQ(values()[13], 101.0F) << "the twelve highest, not the lowest";
}

TEST_F(DicomImage, RefusesNumbersWithACommaByName) {
    write_series([](RawSlice& slice) { slice.position = "0\\0\\1,5"; });
    EXPECT_THAT(refusal(series_),
                HasSubstr("(0020,0032) is '0\\0\\1,5', no numbers as DICOM writes them, with a point"));
}

TEST_F(DicomImage, RefusesWhatGdcmWouldEndTheProgramOver) {
    const auto refused = [&](const std::string& from, const std::string& to) {
        write_series();
        std::string bytes = raw_dicom({});
        write_bytes(series_ / "IM0", with(bytes, from, to));
        return refusal(series_);
    };
    EXPECT_THAT(refused(dicom_number(0x0028, 0x0010, 3), dicom_element(0x0028, 0x0010, "SS", little(3, 2))),
                HasSubstr("(0028,0010) is of form SS and should be of US"));
    EXPECT_THAT(refused(dicom_element(0x0020, 0x0032, "DS", "0\\0\\0"),
                        dicom_element(0x0020, 0x0032, "LO", "0\\0\\0")),
                HasSubstr("(0020,0032) is of form LO and should be of DS"));
    EXPECT_THAT(refused("MONOCHROME2 ", "            "),
                HasSubstr("Photometric Interpretation (0028,0004) is ''"));
    EXPECT_THAT(
        refused(dicom_element(0x0028, 0x0030, "DS", "1\\1"),
                dicom_element(0x0028, 0x0031, "ZZ", "abcd") + dicom_element(0x0028, 0x0030, "DS", "1\\1")),
        HasSubstr("cannot be parsed: (0028,0031) is of the unknown form 'ZZ'"));
    const auto refused_with = [&](RawSlice slice, const std::string& syntax, const std::string& fragments) {
        slice.transfer_syntax = syntax;
        slice.is_encapsulated = true;
        slice.pixels = "";
        std::string bytes = raw_dicom(slice);
        bytes.resize(bytes.size() - (dicom_item("") + dicom_item("") + dicom_sequence_end).size());
        write_bytes(folder_ / "x.dcm", bytes + fragments + dicom_sequence_end);
        return refusal(folder_ / "x.dcm");
    };
    const auto compressed = [&](const std::string& syntax, const std::string& fragments,
                                const char* frames = "") {
        return refused_with({.after_image = hu_as_stored, .frames = frames}, syntax, fragments);
    };
    EXPECT_THAT(compressed("1.2.840.10008.1.2.5", dicom_item("") + dicom_item(std::string(80, '\0'))),
                HasSubstr("is no RLE"));
    EXPECT_THAT(compressed("1.2.840.10008.1.2.4.70", dicom_item("\xff\xd8\xff\xd9")),
                HasSubstr("do not begin with a table of offsets"));
    EXPECT_THAT(compressed("1.2.840.10008.1.2.4.70", dicom_item("")), HasSubstr("without a fragment"));
    EXPECT_THAT(refused_with(multi_frame({0, 1}), "1.2.840.10008.1.2.4.80",
                             dicom_item("") + dicom_item("\xff\xd8 ") + dicom_item("\xff\xd8 ")),
                HasSubstr("its pixel data cannot be decoded"));
    EXPECT_THAT(compressed("1.2.840.10008.1.2.4.80", dicom_item("") + dicom_item("\xff\xd8 "), "2"),
                HasSubstr("has 1 fragments of compressed pixel data"));
    EXPECT_THAT(compressed("1.2.840.10008.1.2.4.201", dicom_item("") + dicom_item("\xff\x4f")),
                HasSubstr("transfer syntax 1.2.840.10008.1.2.4.201, which GDCM does not read"));
}

TEST_F(DicomImage, MayHavePrivateElementsOfNoForm) {
    const auto write = [&](std::uint32_t group, const std::string& form) {
        write_series([&](RawSlice& slice) {
            slice.before_image =
                dicom_element(group, 0x1001, form, "abcd") + dicom_element(group, 0x1002, form, "");
        });
    };
    write(0x0021, std::string(2, '\0'));
    EXPECT_EQ(values()[13], 101.0F);
    for (const std::string form : {"??", "  "}) {
        write(0x0021, form);
        EXPECT_THAT(refusal(series_), HasSubstr("(0021,1001) is of the unknown form '" + form + "'"));
    }
    write(0x0022, std::string(2, '\0'));
    EXPECT_THAT(refusal(series_), HasSubstr("(0022,1001) is of the unknown form"));
}

/// Two frames, and each in pieces of two lengths.
TEST_F(DicomImage, OfFramesMayHaveEachInSeveralFragments) {
    RawSlice file = multi_frame({0, 1});
    for (std::size_t i = 0; i < file.pixels.size(); i += 2) file.pixels[i] = static_cast<char>(i / 5);
    write_bytes(folder_ / "plain.dcm", raw_dicom(file));
    const std::vector<float> expected = values_of(open_image(folder_ / "plain.dcm"));
    compress_as_jpeg2000(folder_ / "plain.dcm", folder_ / "x.dcm");
    std::ifstream in(folder_ / "x.dcm", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::string pixels = dicom_element(0x7fe0, 0x0010, "OB", "", undefined_dicom_length);
    const std::size_t begin = bytes.rfind(pixels) + pixels.size();
    std::vector<std::string> frames;
    for (std::size_t at = begin; bytes.substr(at, 4) == dicom_tag(0xfffe, 0xe000);) {
        std::uint32_t length = 0;
        std::memcpy(&length, &bytes[at + 4], 4);
        if (at != begin) frames.push_back(bytes.substr(at + 8, length));
        at += 8 + length;
    }
    ASSERT_EQ(frames.size(), 2U);
    const auto in_two = [](const std::string& frame) {
        return dicom_item(frame.substr(0, 60)) + dicom_item(frame.substr(60));
    };
    const auto read = [&](const std::string& items) {
        write_bytes(folder_ / "y.dcm", bytes.substr(0, begin) + items + dicom_sequence_end);
        const std::string refused = refusal(folder_ / "y.dcm");
        return !refused.empty()                                       ? refused
               : values_of(open_image(folder_ / "y.dcm")) == expected ? "right"
                                                                      : "wrong";
    };
    const std::string first = in_two(frames[0]), second = in_two(frames[1]);
    const auto second_at = static_cast<std::uint32_t>(first.size());
    EXPECT_EQ(read(dicom_item("") + first + second), "right") << "by the marks of their ends";
    EXPECT_EQ(read(dicom_item(little(0, 4) + little(second_at, 4)) + first + second), "right");
    EXPECT_EQ(read(dicom_item("") + dicom_item(frames[0]) + dicom_item(frames[1]) + dicom_item("")), "right");
    EXPECT_THAT(read(dicom_item("") + first + second + second),
                HasSubstr("its 2 frames cannot be told apart"));
    EXPECT_THAT(read(dicom_item("") + first), HasSubstr("cannot be decoded"));
    EXPECT_THAT(read(dicom_item("") + dicom_item(frames[0].substr(0, 60)) + second), HasSubstr("cannot be"));
}

TEST_F(DicomImage, MayHoldFewerBitsThanItsPixelsTake) {
    write_series([](RawSlice& slice) {
        slice.bits = 32;
        slice.pixel_representation = 0;
        std::string wide;
        for (std::size_t i = 0; i < slice.pixels.size(); i += 2)
            wide += slice.pixels.substr(i, 2) + std::string(2, '\0');
        slice.pixels = wide;
    });
    state_bits(32, 16, 15);
    EXPECT_EQ(values()[13], 101.0F);
}

TEST_F(DicomImage, SaysWhatItLacksOfItsRescale) {
    write_series([](RawSlice& slice) { slice.after_image = dicom_element(0x0028, 0x1053, "DS", "1"); });
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("no Rescale Intercept")));
    write_series([](RawSlice& slice) {
        slice.after_image =
            with(hu_as_stored, dicom_element(0x0028, 0x1052, "DS", "0"),
                 dicom_element(0x0028, 0x1052, "DS", slice.position == "0\\0\\1" ? "-1024" : "0"));
    });
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("Rescale Intercepts (0028,1052) from -1024 to 0")));
    write_series([](RawSlice& slice) {
        slice.after_image =
            dicom_element(0x0028, 0x1052, "DS", "0") + dicom_element(0x0028, 0x1053, "DS", "nan");
    });
    EXPECT_THAT(refusal(series_), HasSubstr("(0028,1053 and 1052) of nan and 0"));
}

TEST_F(DicomImage, EndsBeforeZerosThatFillABlockAndNamesWhatIsNoDicom) {
    write_series();
    for (const auto& entry : std::filesystem::directory_iterator(series_))
        std::ofstream(entry.path(), std::ios::binary | std::ios::app) << std::string(500, '\0');
    std::ofstream(series_ / "IM4").close();
    std::ofstream(series_ / ".DS_Store") << "a Mac's";
    EXPECT_EQ(values()[13], 101.0F);
    EXPECT_THAT(open().image.notes, ElementsAre(HasSubstr("left out IM4, which is no DICOM")));
}

TEST_F(DicomImage, OfFramesMustSayOfEachWhereItLies) {
    RawSlice file = multi_frame({0, 1, 2});
    file.frames = "2";
    write_bytes(folder_ / "x.dcm", raw_dicom(file));
    EXPECT_THAT(refusal(folder_ / "x.dcm"),
                HasSubstr("says that it has 2 frames (0028,0008) and where 3 lie"));
}

TEST_F(DicomImage, OfLabelsMayBeASegmentation) {
    write_bytes(folder_ / "seg.dcm",
                raw_seg({{1, 4, 0b11}, {1, 2, 0b1}, {2, 8, 0b100}, {3, 2, 0b11}}, {"bone", "nerve", "dura"}));
    const Segmentation read = read_segmentation(folder_ / "seg.dcm");
    EXPECT_EQ(read.image.size_voxels, glm::ivec3(4, 3, 4)) << "2 to 8 mm, 2 apart";
    EXPECT_EQ(read.image.spacing_mm, glm::dvec3(0.5, 0.5, 2.0));
    EXPECT_EQ(read.image.origin_mm, glm::dvec3(10.0, 20.0, 2.0));
    ASSERT_EQ(read.segments.size(), 3U);
    const auto has = [&](const std::string& name, int voxel) {
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

TEST_F(DicomImage, OfLabelsLiesWhereItsFramesLieWhateverTheirDigits) {
    const auto gap_of = [&](const std::vector<double>& z_mm, const std::string& stated = "") {
        std::vector<SegFrame> frames;
        for (const double z : z_mm) frames.push_back({1, z, 1});
        write_bytes(
            folder_ / "seg.dcm",
            raw_seg(frames, {"bone"}, 1, stated.empty() ? "" : dicom_element(0x0018, 0x0088, "DS", stated)));
        const SourceImage image = read_segmentation(folder_ / "seg.dcm").image;
        return std::pair(image.spacing_mm.z, image.size_voxels.z);
    };
    EXPECT_EQ(gap_of({0.0, 0.3125, 0.625, 1.5625}), std::pair(0.3125, 6));
    EXPECT_NEAR(gap_of({0.0, 0.07, 0.15, 0.22, 0.3}).first, 0.075, 1e-9) << "two decimals";
    EXPECT_NEAR(gap_of({0.0, 1.0, 2.0, 2.004, 3.0}).first, 1.0, 1e-9)
        << "of two segments' frames of one slice";
    EXPECT_EQ(gap_of({0.0, 2.0, 4.0}, "1"), std::pair(2.0, 3)) << "no gap between frames";
    EXPECT_EQ(gap_of({0.0, 2.0, 4.0, 8.0}, "1"), std::pair(1.0, 9)) << "with empty slices";
    EXPECT_EQ(gap_of({0.0, 1.0, 2.0}, "5"), std::pair(1.0, 3));
}

TEST_F(DicomImage, OfLabelsSaysOfWhichSegmentEachFrameIs) {
    const auto labels_of = [&](const std::string& bytes) {
        write_bytes(folder_ / "seg.dcm", bytes);
        return read_segmentation(folder_ / "seg.dcm").labels.labels_in(0);
    };
    EXPECT_THAT(labels_of(raw_seg({{0, 0, 1}, {0, 2, 1}}, {"bone"})), ElementsAre(1)) << "there is but one";
    const std::string second =
        dicom_element(0x0062, 0x000a, "SQ", dicom_item(dicom_number(0x0062, 0x000b, 2)));
    EXPECT_THAT(labels_of(raw_seg({{0, 0, 1}, {0, 2, 1}}, {"bone", "nerve"}, 1, second)), ElementsAre(2));
    EXPECT_THAT(refusal_of_labels(raw_seg({{0, 0, 1}, {0, 2, 1}}, {"bone", "nerve"})),
                HasSubstr("frame 1 does not say of which segment it is"));
    EXPECT_THAT(refusal_of_labels(raw_seg({{3, 0, 1}, {2, 2, 1}}, {"bone", "nerve"})),
                HasSubstr("frame 1 is of segment 3 (0062,000b), which it does not describe"));
}

TEST_F(DicomImage, OfLabelsMayFillEachFrameToAByte) {
    std::string bytes = raw_seg({{1, 0, 0}, {1, 2, 0}, {1, 4, 0}, {1, 6, 0}, {1, 8, 0}}, {"bone"});
    // Five frames of 12 bits are 8 bytes, and padded 10.
    bytes.resize(bytes.size() - dicom_element(0x7fe0, 0x0010, "OW", std::string(8, '\0')).size());
    write_bytes(folder_ / "seg.dcm",
                bytes + dicom_element(0x7fe0, 0x0010, "OW", std::string("\1\0\2\0\4\0\0\1\0\10", 10)));
    const LabelRows labels = read_segmentation(folder_ / "seg.dcm").labels;
    EXPECT_EQ(labels.at(0, {0, 0, 0}), 1);
    EXPECT_EQ(labels.at(0, {1, 0, 1}), 1);
    EXPECT_EQ(labels.at(0, {2, 0, 2}), 1);
    EXPECT_EQ(labels.at(0, {0, 2, 3}), 1);
    EXPECT_EQ(labels.at(0, {3, 2, 4}), 1);
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
    const std::string good = raw_seg({{1, 0, 1}, {1, 2, 1}, {1, 5, 1}}, {"bone"});
    EXPECT_THAT(refusal_of_labels(good), HasSubstr("lie at no common spacing"));
    EXPECT_THAT(refusal_of_labels(with(good, dicom_element(0x0028, 0x0008, "IS", "3"),
                                       dicom_element(0x0028, 0x0008, "IS", "9"))),
                HasSubstr("9 frames (0028,0008) and where 3 lie"));
    EXPECT_THAT(refusal_of_labels(good.substr(0, good.size() - 4)), HasSubstr("cut off"));
    EXPECT_THAT(refusal_of_labels(with(good, "0.5\\0.5", "nan\\nan")), HasSubstr("spacing"));
    EXPECT_THAT(refusal_of_labels(with(raw_seg({{1, 0, 1}, {1, 2, 1}}, {"bone"}), "10\\20\\2", "10\\26\\2")),
                HasSubstr("gantry tilt"));
}

}  // namespace
}  // namespace osteomill::dicom_image_test
