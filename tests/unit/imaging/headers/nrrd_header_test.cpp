#include "imaging/formats/nrrd_header.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/raw_images.h"

namespace osteomill::nrrd_header_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

ImageHeader layout_of(const std::string& text) {
    return nrrd_image(parse_nrrd_header(bytes_of(text), "x.nrrd"), "x.nrrd");
}

std::string refusal(const std::string& text) {
    return testing::message_of<ImagingError>([&] { layout_of(text); });
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
    EXPECT_EQ(header.key_values.at("key"), "value");
    EXPECT_FALSE(header.fields.contains("voxels"));
}

TEST(NrrdHeader, SaysWhatVoxelsThereAre) {
    const ImageHeader layout = layout_of(testing::nrrd_header("byte skip: -1\n"));
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

/// The place of voxel (1, 1, 1) in patient LPS, mm, with steps of 1, 2 and 3 along the space's own axes from
/// (10, 20, 30).
glm::dvec3 place_in(const std::string& space) {
    const std::string text = with_line("left-posterior-superior", space);
    const bool has_time = space.ends_with("time") || space.size() == 4;
    const std::string time = has_time ? ",0" : "";
    const std::string directions = testing::with(
        text, "(1,0,0) (0,1,0) (0,0,2)", "(1,0,0" + time + ") (0,2,0" + time + ") (0,0,3" + time + ")");
    return position_mm(layout_of(testing::with(directions, "(1,2,3)", "(10,20,30" + time + ")")).image,
                       glm::dvec3(1.0));
}

TEST(NrrdHeader, TurnsEverySpaceToLps) {
    for (const char* name : {"left-posterior-superior", "LEFT-POSTERIOR-SUPERIOR", "LPS", "lps", "LPST",
                             "left-posterior-superior-time"})
        EXPECT_EQ(place_in(name), glm::dvec3(11.0, 22.0, 33.0)) << name;
    for (const char* name : {"right-anterior-superior", "Right-Anterior-Superior", "RAS", "ras", "rast",
                             "right-anterior-superior-time"})
        EXPECT_EQ(place_in(name), glm::dvec3(-11.0, -22.0, 33.0)) << name;
    for (const char* name : {"left-anterior-superior", "LAS", "las", "LAST", "left-anterior-superior-time"})
        EXPECT_EQ(place_in(name), glm::dvec3(11.0, -22.0, 33.0)) << name;
    EXPECT_THAT(refusal(with_line("left-posterior-superior", "left-posterior")),
                HasSubstr("space 'left-posterior' is not read"));
    EXPECT_THAT(refusal(with_line("left-posterior-superior", "elsewhere")),
                HasSubstr("left-posterior-superior (LPS)"));
}

TEST(NrrdHeader, SaysWhereLeftAndRightAreAGuess) {
    EXPECT_TRUE(layout_of(testing::nrrd_header()).image.notes.empty());
    for (const char* space : {"scanner-xyz", "3D-right-handed"}) {
        const ImageHeader image = layout_of(with_line("left-posterior-superior", space));
        EXPECT_FALSE(image.is_placed);
        EXPECT_THAT(image.image.notes.at(0), HasSubstr(testing::sides_are_a_guess));
    }
}

TEST(NrrdHeader, ConvertsItsUnits) {
    const auto edge_mm = [](const std::string& units) {
        return layout_of(testing::nrrd_header("space units: " + units + "\n")).image.spacing_mm.z;
    };
    EXPECT_EQ(edge_mm("\"mm\" \"mm\" \"mm\""), 2.0);
    EXPECT_EQ(edge_mm("\"um\" \"um\" \"um\""), 2e-3);
    EXPECT_EQ(edge_mm("\"\xc2\xb5m\" \"\xc2\xb5m\" \"\xc2\xb5m\""), 2e-3);
    EXPECT_EQ(edge_mm("\"cm\" \"cm\" \"cm\""), 20.0);
    EXPECT_EQ(edge_mm("\"\" \"\" \"\""), 2.0);
    EXPECT_THAT(layout_of(testing::nrrd_header("space units: \"cm\" \"cm\" \"cm\"\n")).image.notes.at(0),
                HasSubstr("converted to mm"));
    EXPECT_THAT(refusal(testing::nrrd_header("space units: \"furlong\" \"mm\" \"mm\"\n")),
                HasSubstr("mm, cm, m, um"));
}

TEST(NrrdHeader, LeavesOutAxesOfOneVoxelThatAreNoneOfSpace) {
    const std::string four = testing::with(testing::nrrd_header(), "dimension: 3", "dimension: 4");
    const auto axes = [&](const std::string& sizes, const std::string& directions) {
        return testing::with(testing::with(four, "3 4 5", sizes), "(1,0,0) (0,1,0) (0,0,2)", directions);
    };
    for (const std::string& text :
         {axes("1 3 4 5", "none (1,0,0) (0,1,0) (0,0,2)"), axes("3 4 5 1", "(1,0,0) (0,1,0) (0,0,2) none")}) {
        EXPECT_EQ(layout_of(text).image.size_voxels, glm::ivec3(3, 4, 5));
        EXPECT_EQ(layout_of(text).layers, 1);
    }
    EXPECT_EQ(layout_of(axes("2 3 4 5", "none (1,0,0) (0,1,0) (0,0,2)")).layers, 2);
    EXPECT_THAT(refusal(axes("3 4 5 2", "(1,0,0) (0,1,0) (0,0,2) none")), HasSubstr("4 dimensions"));
    EXPECT_THAT(refusal(axes("3 4 5 1", "(1,0,0) (0,1,0) (0,0,2)")), HasSubstr("4 axes need"));
}

TEST(NrrdHeader, MakesAxesPerpendicularUpToHalfADegree) {
    const ImageHeader image = layout_of(with_line("(0,1,0)", "(0.0052,1,0)"));  // 0.3 degrees
    EXPECT_NEAR(glm::dot(image.image.direction[0], image.image.direction[1]), 0.0, 1e-12);
    EXPECT_THAT(image.image.notes.at(0),
                HasSubstr("its axes i and j are 89.70 degrees apart; made perpendicular"));
    const glm::dvec3 middle(1.0, 1.5, 2.0);
    EXPECT_LT(glm::distance(position_mm(image.image, middle),
                            glm::dvec3(1.0, 2.0, 3.0) + glm::dvec3(1.0 + 1.5 * 0.0052, 1.5, 4.0)),
              1e-4)
        << "the middle stays";
    EXPECT_THAT(refusal(with_line("(0,1,0)", "(0.012,1,0)")),
                HasSubstr("axes i and j are 89.31 degrees apart"));
    EXPECT_TRUE(layout_of(with_line("(0,1,0)", "(0.000001,1,0)")).image.notes.empty()) << "as printed";
}

TEST(NrrdHeader, MustSaySpacingsWhereItSaysHowFarItsAxesReach) {
    const std::string text = with_line("space directions: (1,0,0) (0,1,0) (0,0,2)\n", "axis mins: 0 0 0\n");
    EXPECT_THAT(refusal(text), HasSubstr("save it with spacings"));
}

TEST(NrrdHeader, UnescapesItsKeys) {
    const std::string text = testing::nrrd_header("name:=a\\nb\\\\c: d\nDICOM:x:=1\nDICOM:y:=2\n");
    const NrrdHeader header = parse_nrrd_header(bytes_of(text), "x.nrrd");
    EXPECT_EQ(header.key_values.at("name"), "a\nb\\c: d");
    EXPECT_EQ(header.key_values.at("DICOM:y"), "2");
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
    EXPECT_EQ(layout_of(testing::nrrd_header("encoding: raw\n")).voxel_bytes, 120U) << "twice the same";
    EXPECT_THAT(refusal(testing::with(testing::nrrd_header(), "endian: little\n", "")),
                HasSubstr("in which order the bytes"));
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
}

}  // namespace
}  // namespace osteomill::nrrd_header_test
