#include "haptic_server/imaging/formats/nrrd_header.h"

#include <gmock/gmock.h>

#include "haptic_server/imaging/imaging_error.h"
#include "tests/support/raw_images.h"

namespace osteomill::nrrd_header_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

NrrdLayout layout_of(const std::string& text) {
    return nrrd_layout(parse_nrrd_header(bytes_of(text), "x.nrrd"), "x.nrrd");
}

std::string refusal(const std::string& text) {
    try {
        layout_of(text);
    } catch (const ImagingError& error) {
        return error.what();
    }
    return "accepted";
}

std::string with_line(const std::string& from, const std::string& to) {
    return testing::with(testing::nrrd_header(), from, to);
}

TEST(NrrdHeader, IsTakenApartUpToTheBlankLine) {
    const std::string text = testing::nrrd_header("# a comment\nkey:=value\nByteSkip: 4\n");
    const NrrdHeader header = parse_nrrd_header(bytes_of(text + "voxels: 1\n"), "x.nrrd");
    EXPECT_EQ(header.bytes, text.size());
    EXPECT_EQ(header.fields.at("space"), "left-posterior-superior");
    EXPECT_EQ(header.fields.at("byte skip"), "4") << "names differ by nothing but case and blanks";
    EXPECT_FALSE(header.fields.contains("key"));
    EXPECT_FALSE(header.fields.contains("voxels"));
}

TEST(NrrdHeader, SaysWhatVoxelsThereAre) {
    const NrrdLayout layout = layout_of(testing::nrrd_header("byte skip: -1\n"));
    EXPECT_EQ(layout.voxel_bytes, 120u);
    EXPECT_EQ(layout.byte_skip, -1);
    EXPECT_EQ(layout_of(with_line("raw", "GZ")).encoding, Encoding::gzip);
    EXPECT_EQ(layout_of(with_line("raw", "ascii")).voxel_bytes, 119u) << "digits and blanks between";
    EXPECT_THAT(layout_of(testing::nrrd_header("data file: s%02d.raw 8 4 -2\n")).data_files,
                ElementsAre("s08.raw", "s06.raw", "s04.raw"));
    EXPECT_THAT(layout_of(testing::nrrd_header("data file: LIST\na.raw\nb c.raw\n")).data_files,
                ElementsAre("a.raw", "b c.raw"));
    EXPECT_THAT(layout_of(testing::nrrd_header("data file: one two.raw\n")).data_files,
                ElementsAre("one two.raw"));
}

TEST(NrrdHeader, RefusesWhatCannotBe) {
    EXPECT_THAT(refusal("MRRD"), HasSubstr("must begin with NRRD"));
    EXPECT_THAT(refusal(with_line("3 4 5", "3 4")), HasSubstr("dimension '3' and sizes '3 4'"));
    EXPECT_THAT(refusal(with_line("3 4 5", "3 4 0")), HasSubstr("an axis of 0 voxels"));
    EXPECT_THAT(refusal(with_line("3 4 5", "3 4 -5")), HasSubstr("an axis of"));
    EXPECT_THAT(refusal(with_line("int16", "block")), HasSubstr("type 'block'"));
    EXPECT_THAT(refusal(with_line("raw", "bzip2")), HasSubstr("encoding 'bzip2' is not read"));
    EXPECT_THAT(refusal(testing::nrrd_header("byte skip: -2\n")), HasSubstr("lead nowhere"));
    EXPECT_THAT(refusal(testing::with(testing::nrrd_header("byte skip: -1\n"), "raw", "gzip")),
                HasSubstr("lead nowhere"));
    EXPECT_THAT(refusal(testing::nrrd_header("sizes: 1 2 3\n")), HasSubstr("'sizes' twice"));
    EXPECT_THAT(refusal(testing::nrrd_header("data file: s%s%d 1 5 1\n")), HasSubstr("no other %"));
    EXPECT_THAT(refusal(testing::nrrd_header("data file: s%d 1 5 0\n")), HasSubstr("FIRST LAST STEP"));
    EXPECT_THAT(refusal(testing::nrrd_header("data file: s%d 1 7 1\n")), HasSubstr("cannot share"));
    EXPECT_THAT(refusal(testing::nrrd_header("data file: LIST\n")), HasSubstr("names none"));
    EXPECT_THAT(refusal(testing::nrrd_header(std::string("a: \0\n", 5))), HasSubstr("zero byte"));
    EXPECT_THAT(refusal("NRRD0005\n" + std::string(most_nrrd_header_bytes, ' ')), HasSubstr("without end"));
}

TEST(NrrdHeader, RefusesNumbersThatNoScanHas) {
    EXPECT_THAT(refusal(with_line("(1,2,3)", "(1e308,0,0)")), HasSubstr("space origin"));
    EXPECT_THAT(refusal(with_line("(1,2,3)", "(nan,0,0)")), HasSubstr("space origin"));
    EXPECT_THAT(refusal(with_line("(1,0,0)", "(1e200,0,0)")), HasSubstr("space directions"));
    EXPECT_THAT(refusal(with_line("(1,0,0)", "(0,0,0)")), HasSubstr("above 0"));
    EXPECT_THAT(refusal(testing::nrrd_header("axis mins: inf 0 0\n")), HasSubstr("axis mins"));
    EXPECT_EQ(refusal(testing::nrrd_header("axis mins: NaN 0 0\n")), "accepted") << "not known";
}

}  // namespace
}  // namespace osteomill::nrrd_header_test
