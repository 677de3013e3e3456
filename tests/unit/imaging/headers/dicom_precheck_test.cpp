#include <gmock/gmock.h>

#include <functional>
#include <stdexcept>

#include "imaging/dicom/dicom_pixels.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/raw_dicom.h"
#include "tests/support/raw_images.h"

namespace osteomill::dicom_precheck_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

std::optional<DicomScan> scan(const std::string& file) {
    return scan_dicom({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, file.size());
}

std::string refusal(const std::string& file) {
    return testing::message_of<std::invalid_argument>([&] {
        if (const auto found = scan(file)) require_sound_pixels(*found);
    });
}

std::string with_elements(const std::string& elements) {
    return raw_dicom({.before_image = elements});
}

std::string refusal_of(const std::function<void(RawSlice&)>& spoil) {
    RawSlice slice;
    spoil(slice);
    return refusal(raw_dicom(slice));
}

TEST(DicomScan, FindsWhatTheImageIs) {
    const std::string file = raw_dicom({.modality = "MR"});
    const DicomScan found = scan(file).value();
    EXPECT_EQ(found.transfer_syntax, explicit_little_endian);
    EXPECT_EQ(found.sop_class, ct_image_storage);
    EXPECT_EQ(found.modality, "MR");
    EXPECT_EQ(found.rows, 3);
    EXPECT_EQ(found.columns, 4);
    EXPECT_EQ(found.bits_allocated, 16);
    EXPECT_EQ(found.pixel_bytes, 24u);
    EXPECT_FALSE(found.is_encapsulated);
    EXPECT_EQ(refusal(file), "");
}

TEST(DicomScan, ReadsEveryCoding) {
    EXPECT_EQ(scan("no image"), std::nullopt);
    EXPECT_EQ(scan(""), std::nullopt);
    const std::string body = dicom_number(0x0028, 0x0010, 3) + dicom_number(0x0028, 0x0011, 4);
    EXPECT_EQ(scan(dicom_start("1.2.840.10008.1.2.1.99") + deflated(body, -15))->columns, 4);
    EXPECT_EQ(
        scan(dicom_start(implicit_little_endian) + dicom_tag(0x0028, 0x0010) + little(2, 4) + little(7, 2))
            ->rows,
        7);
    EXPECT_EQ(scan(dicom_start("1.2.840.10008.1.2.2") + std::string("\0\x28\0\x10US\0\x02\0\x07", 10))->rows,
              7);
    EXPECT_EQ(scan(dicom_element(0x0008, 0x0060, "CS", "CT") + body)->rows, 3) << "without a preamble";
}

TEST(DicomScan, ReadsSequencesWithAndWithoutLengths) {
    const std::string inner = dicom_number(0x0028, 0x0010, 77);
    for (const std::string& sequence :
         {dicom_element(0x0021, 0x1001, "SQ", dicom_item(inner)),
          dicom_element(0x0021, 0x1001, "SQ", dicom_open_item + inner + dicom_item_end + dicom_sequence_end,
                        undefined_dicom_length),
          dicom_element(0x0021, 0x1001, "SQ", "damaged within its length "), nested_sequences(16)})
        EXPECT_EQ(scan(with_elements(sequence))->rows, 3) << "not what stands within";
}

TEST(DicomScan, RefusesDamageWithinASequenceThatStatesItsLength) {
    const auto refusal_around = [](const std::string& content) {
        return refusal(with_elements(dicom_element(0x0040, 0xa730, "SQ", content)));
    };
    EXPECT_EQ(refusal_around(dicom_item(dicom_number(0x0028, 0x0010, 77))), "");
    const std::string swapped_item("\xff\xfe\xe0\0\0\0\0\x0a\0\x28\0\x10US\0\x02\0\x07", 18);
    EXPECT_EQ(refusal_around(swapped_item), "");
    const std::string endless = dicom_element(0x0040, 0xa123, "OB", "", 0x7fffffff);
    for (const std::string& damaged :
         {dicom_item(endless), dicom_item(dicom_element(0x0040, 0xa730, "SQ", dicom_item(endless))),
          dicom_open_item + dicom_number(0x0028, 0x0010, 77),
          dicom_item("") + dicom_sequence_end + "spoiled ", dicom_item("") + "spoiled ",
          dicom_tag(0xfffe, 0xe000) + little(0x7fffffff, 4),
          swapped_item + std::string("\xff\xfe\xe0\0\x7f\xff\xff\xff", 8)})
        EXPECT_THAT(refusal_around(damaged), HasSubstr("cut off or damaged"));
}

TEST(DicomScan, RefusesDeepNestingWhereverItHides) {
    EXPECT_THAT(refusal(with_elements(nested_sequences(17))), HasSubstr("more than 16 sequences"));
    EXPECT_THAT(refusal(with_elements(nested_sequences(200'000))), HasSubstr("more than 16 sequences"));
    std::string closed;
    for (int i = 0; i < 70; ++i) closed = dicom_element(0x0021, 0x1001, "SQ", dicom_item(closed));
    EXPECT_THAT(refusal(with_elements(closed)), HasSubstr("more than 16 sequences"));
    EXPECT_EQ(refusal(with_elements(nested_sequences(16) + nested_sequences(16))), "");
    EXPECT_THAT(refusal(with_elements(dicom_element(0x0021, 0x1001, "SQ", dicom_item(nested_sequences(12))))),
                HasSubstr("too many sequences"))
        << "which takes GDCM minutes";
    const std::string hidden = dicom_item(nested_sequences(17));
    EXPECT_THAT(refusal(with_elements(dicom_element(0x5200, 0x9229, "UN", hidden))),
                HasSubstr("sequences within one another"));
    EXPECT_THAT(refusal(with_elements(dicom_element(0x5200, 0x9229, "UN", hidden + "spoiled "))),
                HasSubstr("sequences within one another"));
    for (const char* representation : {"UN", "OB"})
        EXPECT_THAT(
            refusal(with_elements(dicom_element(0x0021, 0x1001, representation, nested_sequences(2000)))),
            HasSubstr("no sequences"));
}

TEST(DicomScan, RefusesWhatIsCutOffAnywhere) {
    const std::string file = raw_dicom({.before_image = nested_sequences(2)});
    int refused = 0;
    for (std::size_t length = 132; length < file.size(); ++length)
        if (!refusal(file.substr(0, length)).empty()) ++refused;
    EXPECT_GT(refused, static_cast<int>(file.size() - 132) * 9 / 10) << "all but cuts between elements";
    EXPECT_THAT(refusal(file + dicom_element(0x7fe1, 0x0010, "OB", "", 0xfffffffe)), HasSubstr("cut off"));
}

TEST(DicomScan, RefusesPixelsThatCannotBeDecodedOrAreNotThere) {
    for (const std::uint32_t bits : {0u, 1u, 7u, 12u, 64u})
        EXPECT_THAT(refusal_of([&](RawSlice& slice) { slice.bits = bits; }), HasSubstr("Bits Allocated"));
    EXPECT_THAT(refusal_of([](RawSlice& slice) { slice.pixel_representation = 2; }),
                HasSubstr("(0028,0103)"));
    EXPECT_THAT(refusal_of([](RawSlice& slice) { slice.rows = slice.columns = 46'000; }),
                HasSubstr("24 of 4232000000 bytes"));
    for (const char* frames : {"0", "-1", "65537", "many", "99999999999999999999"})
        EXPECT_THAT(refusal(with_elements(dicom_element(0x0028, 0x0008, "IS", frames))),
                    HasSubstr("Number of Frames"));
    EXPECT_THAT(refusal(with_elements(dicom_element(0x0028, 0x0008, "IS", "2"))),
                HasSubstr("24 of 48 bytes"));
}

TEST(DicomScan, HoldsACodestreamAgainstTheHeader) {
    RawSlice slice{.transfer_syntax = jpeg2000_lossless, .is_encapsulated = true};
    slice.pixels = jpeg2000_start(4, 3, true) + "data";
    const DicomScan found = scan(raw_dicom(slice)).value();
    EXPECT_TRUE(found.is_encapsulated);
    EXPECT_EQ(found.pixel_bytes, slice.pixels.size());
    EXPECT_EQ(found.codestream->is_signed, true);
    EXPECT_EQ(refusal(raw_dicom(slice)), "");
    slice.pixels = jpeg2000_start(4, 3, false);
    EXPECT_EQ(scan(raw_dicom(slice))->codestream->is_signed, false);
    slice.pixels = jpeg2000_start(5, 3, false);
    EXPECT_THAT(refusal(raw_dicom(slice)), HasSubstr("pixel data say 5 x 3"));
    slice.pixels = std::string("\xff\xd8\xff\xe0\0\4xx\xff\xc3\0\x0b\x10\0\3\0\4\1\1\x11\0", 21);
    EXPECT_EQ(refusal(raw_dicom(slice)), "");
    slice.pixels[16] = 9;
    EXPECT_THAT(refusal(raw_dicom(slice)), HasSubstr("pixel data say 9 x 3"));
    slice.rows = slice.columns = 40'000;
    slice.pixels = jpeg2000_start(40'000, 40'000, false);
    EXPECT_THAT(refusal(raw_dicom(slice)), HasSubstr(impossible_compression));
}

TEST(DicomScan, TellsWhatHoldsNoCtNumbers) {
    const auto why = [](const std::string& sop_class, const std::string& modality) {
        return why_no_grey_image(DicomScan{.sop_class = sop_class, .modality = modality});
    };
    EXPECT_EQ(why(ct_image_storage, "CT"), "");
    EXPECT_EQ(why("", ""), "");
    EXPECT_EQ(why("1.2.840.10008.5.1.4.1.1.7", "OT"), "") << "secondary capture: pixels all the same";
    EXPECT_EQ(why("1.2.840.10008.5.1.4.1.1.481.1", "RTIMAGE"), "");
    EXPECT_THAT(why("1.2.840.10008.5.1.4.1.1.66.4", "SEG"), HasSubstr("segmentation"));
    EXPECT_THAT(why("1.2.840.10008.5.1.4.1.1.481.2", "RTDOSE"), HasSubstr("radiotherapy"));
    EXPECT_THAT(why("", "SEG"), HasSubstr("modality SEG"));
}

}  // namespace
}  // namespace osteomill::dicom_precheck_test
