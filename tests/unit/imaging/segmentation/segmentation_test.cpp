#include "imaging/segmentation/segmentation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "imaging/imaging_error.h"
#include "imaging/segmentation/segment_structure.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

const std::string two_segments =
    "Segment0_ID:=Segment_1\nSegment0_Name:=bone\nSegment0_Color:=1 0.5 "
    "0\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment1_ID:=Segment_2\nSegment1_Name:=nerve canal\nSegment1_LabelValue:=3\nSegment1_Layer:=1\n";

class SegmentationFile : public ::testing::Test {
  protected:
    void write(const std::string& header, const std::string& voxels) const {
        std::ofstream(path_, std::ios::binary) << "NRRD0004\n" << header << "\n" << voxels;
    }
    std::string refusal() const {
        return testing::message_of<ImagingError>([&] { read_segmentation(path_); });
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "segmentation.seg.nrrd";
};

std::string layered_header(const std::string& keys) {
    return "type: unsigned char\ndimension: 4\nspace: right-anterior-superior\nsizes: 2 3 2 2\n"
           "space directions: none (1,0,0) (0,1,0) (0,0,2)\nkinds: list domain domain domain\n"
           "encoding: raw\nspace origin: (10,20,30)\n" +
           keys;
}

TEST_F(SegmentationFile, HasNamesAndLayersAsSlicerWritesThem) {
    std::string voxels(2 * 3 * 2 * 2, '\0');
    voxels[0] = 1;  // voxel (0, 0, 0): bone and nerve overlap
    voxels[1] = 3;
    voxels[2 * 5 + 1] = 3;  // voxel (2, 1, 0)
    write(layered_header(two_segments), voxels);
    const Segmentation read = read_segmentation(path_);
    EXPECT_EQ(read.labels.layers(), 2);
    EXPECT_EQ(read.image.size_voxels, glm::ivec3(3, 2, 2));
    ASSERT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.segments[0].name, "bone");
    EXPECT_EQ(read.segments[0].colour_rgb, (std::array<std::uint8_t, 3>{255, 128, 0}));
    EXPECT_EQ(read.segments[1].name, "nerve canal");
    EXPECT_EQ(read.segments[1].layer, 1);
    EXPECT_EQ(read.segments[1].label, 3);
    EXPECT_FALSE(read.segments[1].colour_rgb);
    // RAS: x and y point the other way in LPS.
    EXPECT_EQ(position_mm(read.image, {2, 1, 0}), glm::dvec3(-12.0, -21.0, 30.0));
    EXPECT_EQ(read.labels.at(1, {0, 0, 0}), 3);
    EXPECT_EQ(read.labels.at(1, {1, 0, 0}), 0);
    EXPECT_EQ(segment_named(read, "bone").label, 1);
    const Grid grid{.size_voxels = {60, 60, 60}, .spacing_mm = 0.1, .origin_mm = {-14.0, -23.0, 28.0}};
    const StructureMask nerve = structure_of(read, segment_named(read, "nerve canal"), grid);
    EXPECT_TRUE(nerve.contains({20, 20, 20}));
    EXPECT_TRUE(nerve.contains({40, 30, 20}));
    EXPECT_FALSE(nerve.contains({30, 30, 20}));
}

// 3D Slicer up to 4.10 writes segmentations so: a layer for each segment, and no keys of layers or labels.
TEST_F(SegmentationFile, GivesEachSegmentALayerWhereNoneIsNamed) {
    std::string voxels(24, '\0');
    voxels[0] = 1;
    voxels[3] = 1;
    write(layered_header("Segment0_Name:=bone\nSegment1_Name:=nerve\n"), voxels);
    const Segmentation read = read_segmentation(path_);
    ASSERT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.segments[1], (Segment{.name = "nerve", .layer = 1, .label = 1}));
}

TEST_F(SegmentationFile, MayLackANumberOrAName) {
    write(layered_header(
              "Segment0_Name:=bone\nSegment0_LabelValue:=1\nSegment2_Name:=\nSegment2_ID:=Segment_3\n"
              "Segment2_Layer:=0\nSegment2_LabelValue:=2\nSegment5_Name:= "
              "\nSegment5_Layer:=1\nSegment5_LabelValue:=7\n"),
          std::string(24, '\1'));
    const Segmentation read = read_segmentation(path_);
    ASSERT_EQ(read.segments.size(), 3U);
    EXPECT_EQ(read.segments[1].name, "Segment_3");
    EXPECT_EQ(read.segments[1].label, 2);
    EXPECT_EQ(read.segments[2].name, "7");
}

TEST_F(SegmentationFile, MayListItsBackgroundAndSaysWhatItDoesNotList) {
    std::string voxels(24, '\0');
    voxels[0] = 1;
    voxels[2] = 7;
    write(layered_header("Segment0_Name:=background\nSegment0_LabelValue:=0\nSegment0_Layer:=0\n"
                         "Segment1_Name:=bone\nSegment1_LabelValue:=1\nSegment1_Layer:=0\n"),
          voxels);
    const Segmentation read = read_segmentation(path_);
    ASSERT_EQ(read.segments.size(), 1U);
    EXPECT_EQ(read.segments[0].name, "bone");
    EXPECT_THAT(read.image.notes,
                ::testing::Contains(HasSubstr("1 of its labels are none of its segments'")));
}

TEST_F(SegmentationFile, MayBeASingleSlice) {
    write(
        "type: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 1\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nspace origin: (1,1,1)\n",
        std::string("\1\0\0\1", 4));
    const Segmentation read = read_segmentation(path_);
    const Grid grid{.size_voxels = {8, 8, 8}, .spacing_mm = 0.5, .origin_mm = {0.0, 0.0, 0.0}};
    const StructureMask one = structure_of(read, read.segments.at(0), grid);
    EXPECT_TRUE(one.contains({2, 2, 2}));
    EXPECT_FALSE(one.contains({2, 2, 4})) << "no thicker than its slice";
}

TEST_F(SegmentationFile, KeepsNamesAsTheyAre) {
    write(layered_header("Segment0_Name:=a b\\\\c d \"e\" \xc3\xb6: f\nSegment1_Name:=under_score\n"),
          std::string(24, '\1'));
    const Segmentation read = read_segmentation(path_);
    EXPECT_EQ(read.segments[0].name, "a b\\c d \"e\" \xc3\xb6: f");
    EXPECT_EQ(&segment_named(read, "under score"), &read.segments[1]);
}

TEST_F(SegmentationFile, MayBeShortOfWholeByAHundredth) {
    const auto labels = [&](std::initializer_list<float> values) {
        std::string voxels;
        for (const float value : values) {
            voxels.resize(voxels.size() + 4);
            std::memcpy(voxels.data() + voxels.size() - 4, &value, 4);
        }
        write(
            "type: float\ndimension: 3\nspace: LPS\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
            "endian: little\nencoding: raw\n",
            voxels);
    };
    labels({0.0F, 0.99999F, 2.009F, 65535.0F, 0.0F, 0.0F, 0.0F, 0.0F});
    const LabelRows read = read_segmentation(path_).labels;
    EXPECT_EQ(read.at(0, {1, 0, 0}), 1);
    EXPECT_EQ(read.at(0, {0, 1, 0}), 2);
    EXPECT_EQ(read.at(0, {1, 1, 0}), 65535);
    EXPECT_EQ(read.at(0, {1, 1, 1}), 0);
    labels({0.0F, 0.98F, 2.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F});
    EXPECT_THAT(refusal(), HasSubstr("it holds 0.98"));
}

TEST_F(SegmentationFile, MayBeAMetaImage) {
    path_ = folder_ / "labels.mha";
    std::ofstream(path_, std::ios::binary)
        << "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = "
           "1 2 3\n"
           "ElementSpacing = 1 1 1\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        << std::string("\0\1\2\0\0\0\0\0", 8);
    const Segmentation read = read_segmentation(path_);
    ASSERT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.segments[1].name, "2");
    EXPECT_EQ(read.image.origin_mm, glm::dvec3(1.0, 2.0, 3.0));
}

TEST_F(SegmentationFile, NamesTheNearestSegment) {
    write(layered_header(two_segments), std::string(24, '\1'));
    const Segmentation read = read_segmentation(path_);
    EXPECT_THROW(
        try { segment_named(read, "nerve cannal"); } catch (const ImagingError& error) {
            EXPECT_THAT(error.what(), HasSubstr("did you mean \"nerve canal\""));
            throw;
        },
        ImagingError);
}

TEST_F(SegmentationFile, IsRefusedInOneLineWhereItIsNone) {
    EXPECT_THAT(refusal(), HasSubstr("segmentation.seg.nrrd"));
    write(layered_header(two_segments), "torn");
    EXPECT_NE(refusal(), "");
    write(layered_header("Segment0_Name:=a\nSegment1_Name:=b\nSegment2_Name:=c\n"), std::string(24, '\1'));
    EXPECT_THAT(refusal(), HasSubstr("Segment2_Layer '2'"));
    write(layered_header(""), std::string(24, '\1'));
    EXPECT_THAT(refusal(), HasSubstr("names no segments"));
    write(layered_header("Segment0_Name:=a\nSegment0_Layer:=2\n"), std::string(24, '\1'));
    EXPECT_THAT(refusal(), HasSubstr("Segment0_Layer '2'"));
    write(layered_header("Segment0_Name:=a\nSegment0_LabelValue:=-7\n"), std::string(24, '\1'));
    EXPECT_THAT(refusal(), HasSubstr("Segment0_LabelValue '-7'"));
    write(layered_header("Segment0_Name:=a\nSegment1_Name:=a\n"), std::string(24, '\1'));
    EXPECT_THAT(refusal(), HasSubstr("two segments called \"a\""));
    const std::string ct =
        "type: short\ndimension: 3\nspace: LPS\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
        "endian: little\nencoding: raw\nspace origin: (0,0,0)\n";
    write(ct, std::string(16, '\xfc'));
    EXPECT_THAT(refusal(), HasSubstr("is no label map"));
}

// A sphere of 6 mm, of which the scan's voxels of 0.5 x 0.5 x 1.2 mm say only whether their centre is inside.
TEST_F(SegmentationFile, ComesOntoTheBonesGridWithoutTheScansStaircase) {
    constexpr double radius_mm = 6.0;
    const glm::dvec3 spacing_mm(0.5, 0.5, 1.2);
    const glm::ivec3 size(36, 36, 16);
    const glm::dvec3 middle_mm(8.8, 8.6, 9.1);
    std::string voxels;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                voxels +=
                    glm::distance(spacing_mm * glm::dvec3(i, j, k), middle_mm) < radius_mm ? '\5' : '\0';
    write(
        "type: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 36 36 16\n"
        "space directions: (0.5,0,0) (0,0.5,0) (0,0,1.2)\nencoding: raw\nspace origin: (0,0,0)\n",
        voxels);
    const Segmentation read = read_segmentation(path_);
    ASSERT_EQ(read.segments.size(), 1U);
    EXPECT_EQ(read.segments[0].name, "segmentation");  // the only label of a plain label map: its file's
    EXPECT_EQ(&segment_named(read, "5"), &read.segments[0]);
    const Grid grid{.size_voxels = {90, 90, 95}, .spacing_mm = 0.2, .origin_mm = {}};
    const StructureMask mask = structure_of(read, read.segments[0], grid);
    const double exact_mm3 = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_mm, 3);
    EXPECT_NEAR(mask.volume_mm3(), exact_mm3, 0.02 * exact_mm3);
    double worst_mm = 0.0;
    double sum_mm = 0.0;
    int count = 0;
    glm::ivec3 v;
    for (v.z = 1; v.z < 94; ++v.z)
        for (v.y = 1; v.y < 89; ++v.y)
            for (v.x = 1; v.x < 89; ++v.x) {
                const bool in = mask.contains(v);
                if (in == mask.contains(v + glm::ivec3(1, 0, 0)) &&
                    in == mask.contains(v + glm::ivec3(0, 1, 0)) &&
                    in == mask.contains(v + glm::ivec3(0, 0, 1)))
                    continue;
                const double off_mm =
                    std::abs(glm::distance(centre_of_voxel_mm(grid, v), middle_mm) - radius_mm);
                worst_mm = std::max(worst_mm, off_mm);
                sum_mm += off_mm;
                ++count;
            }
    EXPECT_LT(worst_mm, 0.8);        // two thirds of the scan's coarsest voxel
    EXPECT_LT(sum_mm / count, 0.2);  // a voxel of the bone's grid in the mean
}

void write_map(const std::filesystem::path& path, const std::vector<float>& values) {
    std::ofstream out(path, std::ios::binary);
    out << "NRRD0004\ntype: float\ndimension: 3\nspace: LPS\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) "
           "(0,0,1)\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n\n";
    out.write(reinterpret_cast<const char*>(values.data()), std::streamsize(4 * values.size()));
}

TEST_F(SegmentationFile, NamesOfATableThatComeTwiceAreToldApart) {
    const auto path = folder_ / "map.nrrd";
    write_map(path, {0.0F, 50.0F, 51.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F});
    Segmentation read = read_segmentation(path);
    name_segments(read, {{50, {"ctx", {1, 1, 1}}}, {51, {"ctx", {2, 2, 2}}}});
    EXPECT_EQ(read.segments[0].name, "1");
    EXPECT_EQ(read.segments[1].name, "ctx");
    EXPECT_EQ(read.segments[2].name, "ctx (51)");
}

// Rods of 2 mm that a segmentation of 0.5 mm shows in four voxels, and a ball of 6 mm.
TEST_F(SegmentationFile, IsAsLargeOnTheBonesGridAsItsVoxelsAre) {
    const glm::ivec3 size(28, 26, 24);
    const glm::dvec3 middle_mm(6.7, 6.2, 5.9);
    const auto as_large = [&](const std::function<bool(const glm::dvec3&)>& is_in) {
        std::string voxels;
        glm::ivec3 v;
        for (v.z = 0; v.z < size.z; ++v.z)
            for (v.y = 0; v.y < size.y; ++v.y)
                for (v.x = 0; v.x < size.x; ++v.x)
                    voxels += is_in(0.5 * glm::dvec3(v) - middle_mm) ? '\1' : '\0';
        write(
            "type: uint8\ndimension: 3\nspace: LPS\nsizes: 28 26 24\nspace directions: (0.5,0,0) (0,0.5,0) "
            "(0,0,0.5)\nencoding: raw\nspace origin: (0,0,0)\n",
            voxels);
        const Segmentation read = read_segmentation(path_);
        const Grid grid{
            .size_voxels = {150, 140, 130}, .spacing_mm = 0.1, .origin_mm = {-0.53, -0.52, -0.51}};
        return structure_of(read, read.segments[0], grid).volume_mm3() /
               (0.125 * static_cast<double>(std::ranges::count(voxels, '\1')));
    };
    for (const glm::dvec3& along : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(-2, 1, 0)})
        EXPECT_NEAR(as_large([&](const glm::dvec3& at_mm) {
                        const glm::dvec3 unit = glm::normalize(along);
                        return std::abs(glm::dot(at_mm, unit)) < 4.5 &&
                               glm::length(glm::cross(at_mm, unit)) < 1.0;
                    }),
                    1.0, 0.01);
    EXPECT_NEAR(as_large([](const glm::dvec3& at_mm) { return glm::length(at_mm) < 3.0; }), 1.0, 0.01);
}

// 3D Slicer cuts a file to its segments: as far as it goes everything may be labelled, and nothing beyond it.
TEST_F(SegmentationFile, EndsWhereItsFileEnds) {
    write(
        "type: uint8\ndimension: 3\nspace: LPS\nsizes: 4 4 20\nspace directions: (1,0,0) (0,1,0) "
        "(0,0,1)\nencoding: raw\nspace origin: (0,0,0)\n",
        std::string(4 * 4 * 20, '\1'));
    const Segmentation read = read_segmentation(path_);
    for (const double spacing_mm : {0.5, 0.3, 0.2}) {
        const Grid grid{.size_voxels = glm::ivec3(glm::dvec3(20.0, 20.0, 40.0) / spacing_mm),
                        .spacing_mm = spacing_mm,
                        .origin_mm = glm::dvec3(-8.1)};
        const StructureMask mask = structure_of(read, read.segments[0], grid);
        EXPECT_NEAR(mask.volume_mm3(), 320.0, 0.04 * 320.0) << spacing_mm;
    }
}

}  // namespace
}  // namespace osteomill
