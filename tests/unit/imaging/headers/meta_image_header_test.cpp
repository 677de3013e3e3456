#include "imaging/formats/meta_image_header.h"

#include <gmock/gmock.h>

#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/raw_images.h"

namespace osteomill::meta_image_header_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::meta_header;
using testing::with;

ImageHeader parse(const std::string& text) {
    return parse_meta_image_header({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                                   "x.mhd");
}

std::string refusal(const std::string& text) {
    return testing::message_of<ImagingError>([&] { parse(text); });
}

TEST(MetaImageHeader, SaysWhereTheImageLiesAndItsVoxels) {
    const std::string text = meta_header("LOCAL", "TransformMatrix = 0 1 0 1 0 0 0 0 -1\n");
    const ImageHeader header = parse(text + "voxels = 1\n");
    EXPECT_EQ(header.image.size_voxels, glm::ivec3(3, 4, 5));
    EXPECT_EQ(header.image.spacing_mm, glm::dvec3(1.0, 1.0, 2.0));
    EXPECT_EQ(header.image.origin_mm, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(header.image.direction[0], glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(header.image.direction[2], glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(header.bytes, text.size());
    EXPECT_EQ(header.voxels.type, VoxelType::int16);
    EXPECT_FALSE(header.voxels.big_endian);
    EXPECT_TRUE(header.data_files.empty());
}

TEST(MetaImageHeader, CountsTheFilesOfItsSlices) {
    EXPECT_THAT(parse(meta_header("s%02d.raw 3 11 2")).data_files,
                ElementsAre("s03.raw", "s05.raw", "s07.raw", "s09.raw", "s11.raw"));
    EXPECT_THAT(parse(meta_header("s%d.raw")).data_files, ::testing::SizeIs(5)) << "from 1, one a slice";
    EXPECT_THAT(parse(meta_header("LIST\na\nb\nc\nd\ne\n")).data_files, ElementsAre("a", "b", "c", "d", "e"));
    EXPECT_THAT(parse(meta_header("one file.raw")).data_files, ElementsAre("one file.raw"));
    EXPECT_THAT(refusal(meta_header("s%d.raw 1 4 1")), HasSubstr("names 4 files, where DimSize has 5"));
    EXPECT_THAT(refusal(meta_header("s%d.raw 5 1 1")), HasSubstr("names none"));
    EXPECT_THAT(refusal(meta_header("s%d.raw -1 5 1")), HasSubstr("FIRST LAST STEP"));
    EXPECT_THAT(refusal(meta_header("LIST\na\nb")), HasSubstr("names 2 files"));
    EXPECT_THAT(refusal(meta_header("s%s")), HasSubstr("no other %"));
}

TEST(MetaImageHeader, ConvertsItsUnitsAndSaysWhereLeftAndRightAreAGuess) {
    const ImageHeader header = parse(meta_header("LOCAL", "DistanceUnits = um\n"));
    EXPECT_EQ(header.image.spacing_mm, glm::dvec3(1e-3, 1e-3, 2e-3));
    EXPECT_EQ(header.image.origin_mm.z, 3e-3);
    EXPECT_THAT(header.image.notes,
                ElementsAre(HasSubstr("converted to mm"), HasSubstr(testing::sides_are_a_guess)));
    EXPECT_TRUE(parse(meta_header("LOCAL", "TransformMatrix = 1 0 0 0 1 0 0 0 1\n")).image.notes.empty());
}

TEST(MetaImageHeader, MaySayTheSameTwice) {
    const std::string again = "ElementByteOrderMSB = False\nOrigin = 1 2 3\nDimSize = 3 4 5\n";
    EXPECT_EQ(parse(meta_header("LOCAL", again + "Comment = a\nComment = b\n")).image.origin_mm.z, 3.0);
    EXPECT_THAT(refusal(meta_header("LOCAL", "ElementByteOrderMSB = True\n")),
                HasSubstr("says other than BinaryDataByteOrderMSB"));
}

TEST(MetaImageHeader, MayHaveAFourthAxisOfOneVoxel) {
    std::string text = with(meta_header(), "NDims = 3", "NDims = 4");
    text = with(with(with(text, "3 4 5", "3 4 5 1"), "1 1 2", "1 1 2 1"), "1 2 3", "1 2 3 0");
    EXPECT_EQ(parse(text).image.size_voxels, glm::ivec3(3, 4, 5));
    EXPECT_THAT(refusal(with(text, "3 4 5 1", "3 4 5 2")), HasSubstr("4 dimensions"));
}

TEST(MetaImageHeader, RefusesWhatCannotBe) {
    EXPECT_THAT(refusal("NDims = 3\n"), HasSubstr("no line ElementDataFile"));
    EXPECT_THAT(refusal(std::string(most_meta_image_header_bytes, 'a')), HasSubstr("no end"));
    EXPECT_THAT(refusal(with(meta_header(), "NDims = 3", "NDims = -1")), HasSubstr("-1 dimensions"));
    EXPECT_THAT(refusal(with(meta_header(), "3 4 5", "3 4")), HasSubstr("DimSize '3 4' must be 3 numbers"));
    EXPECT_THAT(refusal(with(meta_header(), "3 4 5", "3 4 nan")), HasSubstr("DimSize"));
    EXPECT_THAT(refusal(with(meta_header(), "MET_SHORT", "MET_STRING")), HasSubstr("ElementType"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "DimSize = 1 2 3\n")),
                HasSubstr("stands there again as '3 4 5'"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "Origin = 1 2 4\n")), HasSubstr("says other than Offset"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "HeaderSize = -2\n")), HasSubstr("HeaderSize"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "ElementNumberOfChannels = 3\n")), HasSubstr("colour"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "DistanceUnits = furlong\n")), HasSubstr("mm, cm, m, um"));
}

TEST(MetaImageHeader, SaysWhatElementsAreAsMetaIoDoes) {
    const std::string plain = with(meta_header(), "BinaryData = True\n", "");
    EXPECT_EQ(parse(plain).encoding, Encoding::raw) << "binary where it says nothing";
    EXPECT_EQ(parse(with(meta_header(), "BinaryData = True", "BinaryData = False")).encoding, Encoding::text);
    EXPECT_EQ(parse(with(meta_header(), "MET_SHORT", "MET_LONG_LONG")).voxels.type, VoxelType::int64);
    EXPECT_EQ(parse(with(meta_header(), "MET_SHORT", "MET_ULONG")).voxels.type, VoxelType::uint32);
}

// The tilt here is the rounding of a matrix of four digits.
TEST(MetaImageHeader, SaysNothingOfAxesThatRoundingTilts) {
    const std::string text = meta_header(
        "LOCAL", "TransformMatrix = 0.8450 -0.1978 0.4969 0.3647 0.8927 -0.2647 -0.3912 0.4049 0.8265\n");
    EXPECT_THAT(parse(text).image.notes, ElementsAre());
}

TEST(MetaImageHeader, RefusesAGeometryThatNoScanHas) {
    EXPECT_THAT(refusal(with(meta_header(), "1 2 3", "1e308 0 0")), HasSubstr("Offset"));
    EXPECT_THAT(refusal(with(meta_header(), "1 1 2", "1e-9 1 1")), HasSubstr("ElementSpacing 1e-09 mm"));
    EXPECT_THAT(refusal(with(meta_header(), "1 1 2", "1 nan 1")), HasSubstr("above 0"));
    EXPECT_THAT(refusal(meta_header("LOCAL", "TransformMatrix = 1 0 0 1 1 0 0 0 1\n")),
                HasSubstr("not perpendicular"));
}

}  // namespace
}  // namespace osteomill::meta_image_header_test
