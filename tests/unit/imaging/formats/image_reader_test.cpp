#include "imaging/formats/image_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>

#include "imaging/imaging_error.h"
#include "tests/support/synthetic_dicom.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_image.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto silent = [](double) {};

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// A NRRD of 3 x 4 x 5 int16 zeros with the given header lines besides.
std::string raw_nrrd(const std::string& lines, std::size_t bytes = 3 * 4 * 5 * 2) {
    return "NRRD0005\ntype: int16\ndimension: 3\nsizes: 3 4 5\nencoding: raw\nendian: little\n" + lines +
           "\n" + std::string(bytes, '\0');
}

/// A NIfTI-1 file of 3 x 4 x 5 int16 zeros.
std::string raw_nifti(float middle_spacing_mm, std::size_t bytes = 3 * 4 * 5 * 2) {
    std::string file(352 + bytes, '\0');
    const auto put = [&](std::size_t offset, auto value) {
        std::memcpy(file.data() + offset, &value, sizeof value);
    };
    put(0, std::int32_t{348});
    constexpr std::array<std::int16_t, 8> size{3, 3, 4, 5, 1, 1, 1, 1};
    put(40, size);
    put(70, std::int16_t{4});   // int16
    put(72, std::int16_t{16});  // bits
    put(76, std::array{1.0F, 2.0F, middle_spacing_mm, 2.0F});
    put(108, 352.0F);
    put(254, std::int16_t{1});  // orientation from the rows below, RAS
    put(280, std::array{2.0F, 0.0F, 0.0F, 10.0F, 0.0F, 2.0F, 0.0F, 20.0F, 0.0F, 0.0F, 2.0F, 30.0F});
    put(344, std::array{'n', '+', '1', '\0'});
    return file;
}

std::string raw_mha(const std::string& spacing, std::size_t bytes = 3 * 4 * 5 * 2) {
    return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = 1 2 "
           "3\n"
           "ElementSpacing = " +
           spacing + "\nDimSize = 3 4 5\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
           std::string(bytes, '\0');
}

class ImageReader : public ::testing::Test {
  protected:
    /// The one line that refuses a path, read to the last voxel.
    std::string refusal(const std::filesystem::path& path,
                        const std::optional<std::string>& uid = std::nullopt) {
        try {
            values_of(open_image(path, {.series_uid = uid}));
        } catch (const ImagingError& error) {
            const std::string line = error.what();
            EXPECT_THAT(line, Not(HasSubstr("\n")));
            EXPECT_THAT(line, HasSubstr(folder_.path().string())) << "names the file";
            return line;
        }
        return "accepted";
    }
    std::string refusal_of_text(const std::string& name, const std::string& text) {
        write_text(folder_ / name, text);
        return refusal(folder_ / name);
    }
    std::string refusal_of_series(const std::vector<testing::SyntheticSlice>& slices) {
        testing::write_series(folder_ / "series", slices);
        return refusal(folder_ / "series");
    }
    testing::TemporaryFolder folder_;
};

TEST_F(ImageReader, PlacesADicomSeriesAndAppliesEachSlicesOwnRescale) {
    std::vector<testing::SyntheticSlice> slices = testing::synthetic_series(4);
    slices[2].slope = 2.0;
    slices[2].intercept = -2448.0;
    slices[1].stored[3 + 12 * 2] = 3000;
    std::swap(slices[0], slices[3]);
    testing::write_series(folder_ / "series", slices);
    OpenedImage opened = open_image(folder_ / "series");
    EXPECT_EQ(opened.image.size_voxels, glm::ivec3(12, 10, 4));
    const std::vector<float> values = values_of(opened);
    EXPECT_FLOAT_EQ(values[0], 0.0F);
    EXPECT_FLOAT_EQ(values[120 + 3 + 12 * 2], 1976.0F);
    EXPECT_EQ(position_mm(opened.image, {3.0, 2.0, 1.0}), glm::dvec3(-2.0, -2.0, 2.0));
    EXPECT_FLOAT_EQ(values[240], 0.0F) << "2 * 1224 - 2448";
    EXPECT_FLOAT_EQ(values[360], 300.0F);
}

TEST_F(ImageReader, TakesTheLargestSeriesNamesTheOthersAndLetsOneBePicked) {
    std::vector<testing::SyntheticSlice> slices = testing::synthetic_series(5);
    for (testing::SyntheticSlice slice : testing::synthetic_series(3)) {
        slice.series_uid = "1.2.3.4";
        slices.push_back(slice);
    }
    testing::write_series(folder_ / "series", slices);
    const OpenedImage largest = open_image(folder_ / "series");
    EXPECT_EQ(largest.image.size_voxels.z, 5);
    ASSERT_EQ(largest.image.notes.size(), 1u);
    EXPECT_THAT(largest.image.notes[0], HasSubstr("1.2.3.4 (3 slices)"));
    EXPECT_EQ(open_image(folder_ / "series", {.series_uid = "1.2.3.4"}).image.size_voxels.z, 3);
    EXPECT_THAT(refusal(folder_ / "series", "9.9"), HasSubstr("holds no series 9.9; it holds"));
}

TEST_F(ImageReader, RefusesWhatIsNoVolumeInDicom) {
    std::vector<testing::SyntheticSlice> slices = testing::synthetic_series(4);
    slices[2].with_pixel_data = false;
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("02.dcm: has no pixel data"));
    slices = testing::synthetic_series(4);
    slices[1].with_pixel_spacing = false;
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("no Pixel Spacing"));
    slices = testing::synthetic_series(4);
    for (auto& slice : slices) slice.samples_per_pixel = 3;
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("3 samples a pixel"));
    slices = testing::synthetic_series(4);
    slices[3].samples_per_pixel = 3;  // a picture beside the scan
    EXPECT_EQ(refusal_of_series(slices), "accepted");
    slices = testing::synthetic_series(4);
    slices[1].frames = "7";
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("multi-frame"));
    slices = testing::synthetic_series(4);
    slices[3].position_mm.z += 2.0;
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("1 missing slice"));
    slices = testing::synthetic_series(4);
    for (auto& slice : slices) slice.pixel_spacing_mm = {0.0, 1.0};
    EXPECT_THAT(refusal_of_series(slices), HasSubstr("must be above 0"));
}

TEST_F(ImageReader, RefusesADicomFileThatIsCutOff) {
    testing::write_series(folder_ / "series", testing::synthetic_series(4));
    const std::filesystem::path cut = folder_ / "series/02.dcm";
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 100);
    EXPECT_THAT(refusal(folder_ / "series"), HasSubstr("02.dcm"));
}

TEST_F(ImageReader, RefusesAPathAFolderOrAFileWithoutAnImage) {
    EXPECT_THAT(refusal(folder_ / "nowhere"), HasSubstr("does not exist"));
    std::filesystem::create_directory(folder_ / "empty");
    EXPECT_THAT(refusal(folder_ / "empty"), HasSubstr("holds no files"));
    std::filesystem::create_directory(folder_ / "texts");
    write_text(folder_ / "texts/readme", "no image");
    EXPECT_THAT(refusal(folder_ / "texts"), HasSubstr("no DICOM images"));
    EXPECT_THAT(
        refusal_of_text("notes.txt", "no image"),
        HasSubstr("is no NRRD (.nrrd, .nhdr), NIfTI (.nii, .nii.gz), folder of PNG or TIFF pictures, DICOM "
                  "folder or file or MetaImage (.mha, "
                  ".mhd): it begins as none of them"));
    EXPECT_THAT(refusal_of_text("empty.nrrd", ""), HasSubstr("is empty"));
}

TEST_F(ImageReader, ReadsNrrdInItsOwnSpaceAndSaysWhenItHasNone) {
    write_text(folder_ / "ras.nrrd",
               raw_nrrd("space: right-anterior-superior\nspace directions: (2,0,0) (0,3,0) (0,0,4)\n"
                        "space origin: (10,20,30)\n"));
    const OpenedImage ras = open_image(folder_ / "ras.nrrd");
    EXPECT_EQ(position_mm(ras.image, {1.0, 1.0, 1.0}), glm::dvec3(-12.0, -23.0, 34.0));
    EXPECT_TRUE(ras.image.notes.empty());
    write_text(folder_ / "plain.nrrd", raw_nrrd("spacings: 1 1 2\n"));
    EXPECT_THAT(open_image(folder_ / "plain.nrrd").image.notes.at(0), HasSubstr("taken as left-posterior"));
}

TEST_F(ImageReader, RefusesNrrdWithSpacingsThatAreNone) {
    EXPECT_THAT(refusal_of_text("zero.nrrd", raw_nrrd("spacings: 1 0 2\n")), HasSubstr("above 0"));
    EXPECT_THAT(refusal_of_text("nan.nrrd", raw_nrrd("spacings: 1 nan 2\n")), HasSubstr("above 0"));
    EXPECT_THAT(
        refusal_of_text(
            "sheared.nrrd",
            raw_nrrd("space: left-posterior-superior\nspace directions: (1,0,0) (0.3,1,0) (0,0,1)\n")),
        HasSubstr("not perpendicular"));
}

TEST_F(ImageReader, RefusesFilesThatAreCutOff) {
    EXPECT_THAT(refusal_of_text("cut.nrrd", raw_nrrd("spacings: 1 1 1\n", 50)), HasSubstr("cut off"));
    EXPECT_THAT(refusal_of_text("cut.mha", raw_mha("1 1 1", 50)), HasSubstr("cut off"));
    EXPECT_THAT(refusal_of_text("header.nrrd", "NRRD0005\ntype: int16\n"), HasSubstr("cut off"));
    EXPECT_THAT(refusal_of_text("cut.nii", raw_nifti(2.0F).substr(0, 200)), HasSubstr("cut off"));
}

TEST_F(ImageReader, ReadsMetaImageAndRefusesItsFaults) {
    write_text(folder_ / "good.mha", raw_mha("1 1 2"));
    const OpenedImage good = open_image(folder_ / "good.mha");
    EXPECT_EQ(position_mm(good.image, {0.0, 0.0, 1.0}), glm::dvec3(1.0, 2.0, 5.0));
    EXPECT_THAT(refusal_of_text("zero.mha", raw_mha("1 0 1")), HasSubstr("above 0"));
    EXPECT_THAT(refusal_of_text("nan.mha", raw_mha("1 nan 1")), HasSubstr("above 0"));
}

TEST_F(ImageReader, ReadsWhatIsCalledImgByItsContent) {
    write_text(folder_ / "volume.img", raw_mha("1 1 2"));
    EXPECT_EQ(open_image(folder_ / "volume.img").image.spacing_mm, glm::dvec3(1.0, 1.0, 2.0));
    EXPECT_THAT(refusal_of_text("other.img", std::string(200, '\0')),
                HasSubstr("its other half, other.hdr, is missing"));
}

TEST_F(ImageReader, ReadsNiftiInLpsAndRefusesItsFaults) {
    write_text(folder_ / "good.nii", raw_nifti(2.0F));
    const OpenedImage good = open_image(folder_ / "good.nii");
    EXPECT_LT(glm::distance(position_mm(good.image, {1.0, 1.0, 1.0}), glm::dvec3(-12.0, -22.0, 32.0)), 1e-5);
    EXPECT_THAT(refusal_of_text("half.nii", raw_nifti(2.0F, 50)), HasSubstr("is cut off"));
}

TEST_F(ImageReader, RefusesColourFourDimensionsAndSingleSlices) {
    const auto header = [](const char* sizes, int dimension, const char* more) {
        return "NRRD0005\ntype: uint8\ndimension: " + std::to_string(dimension) + "\nsizes: " + sizes +
               "\nencoding: raw\n" + more + "\n" + std::string(360, '\0');
    };
    EXPECT_THAT(refusal_of_text("rgb.nrrd", header("3 4 5 6", 4, "kinds: RGB-color space space space\n")),
                HasSubstr("3 values a voxel"));
    EXPECT_THAT(refusal_of_text("time.nrrd", header("3 4 5 6", 4, "")), HasSubstr("4 dimensions"));
    EXPECT_THAT(refusal_of_text("flat.nrrd", header("12 30 1", 3, "")), HasSubstr("single slice"));
    EXPECT_THAT(refusal_of_text("plane.nrrd", header("12 30", 2, "")), HasSubstr("2 dimensions"));
}

TEST(ImageNames, AreKnownByTheirEndingInAnyCase) {
    for (const char* name : {"mandible.nii.gz", "MANDIBLE.NII.GZ", "Mandible.seg.nrrd", "a.MHA"})
        EXPECT_TRUE(is_image_name(name)) << name;
    for (const char* name : {"mandible.txt", "nii", "mandible.nii.gz.part", "._mandible.nii.gz"})
        EXPECT_FALSE(is_image_name(name)) << name;
    EXPECT_EQ(name_without_ending("MANDIBLE.NII.GZ"), "MANDIBLE");
}

}  // namespace
}  // namespace osteomill
