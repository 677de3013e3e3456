#include "imaging/formats/picture_stack.h"

#include <gmock/gmock.h>
#include <png.h>
#include <tiffio.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "imaging/formats/picture_file.h"
#include "imaging/imaging_error.h"
#include "imaging/segmentation/segmentation.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_image.h"

namespace osteomill {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const glm::dvec3 spacing_mm(0.2, 0.3, 0.4);

/// `format`: PNG_FORMAT_RGBA or PNG_FORMAT_GRAY, of 8 bits.
void write_png_picture(const std::filesystem::path& path, int width, int height, std::uint32_t format,
                       const std::vector<std::uint8_t>& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0)
        throw std::runtime_error("cannot write " + path.string());
}

struct TiffTags {
    int orientation = ORIENTATION_TOPLEFT;
    int photometric = PHOTOMETRIC_MINISBLACK;
    const char* description = "";
};

/// Grey, a page for each, `bits` of 8 or 16.
template <typename Sample>
void write_tiff_pages(const std::filesystem::path& path, int width, int height,
                      const std::vector<std::vector<Sample>>& pages, const TiffTags& tags = {}) {
    TIFF* tiff = TIFFOpen(path.c_str(), "w");
    if (tiff == nullptr) throw std::runtime_error("cannot write " + path.string());
    for (const std::vector<Sample>& page : pages) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, int{8 * sizeof(Sample)});
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, tags.photometric);
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, tags.orientation);
        if (*tags.description != '\0') TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, tags.description);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
        for (int y = 0; y < height; ++y)
            TIFFWriteScanline(tiff, const_cast<Sample*>(&page[static_cast<std::size_t>(y * width)]),
                              static_cast<std::uint32_t>(y), 0);
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
}

class PictureStackFolder : public ::testing::Test {
  protected:
    std::string refusal() const {
        return testing::message_of<ImagingError>(
            [&] { values_of(open_picture_stack(folder_.path(), spacing_mm)); });
    }
    std::vector<float> values() const { return values_of(open_picture_stack(folder_.path(), spacing_mm)); }
    testing::TemporaryFolder folder_;
};

TEST_F(PictureStackFolder, IsInTheOrderOfTheNumbersInItsNames) {
    for (const std::uint8_t number : std::vector<std::uint8_t>{9, 10, 100, 1})
        write_png_picture(folder_ / ("plane" + std::to_string(number) + ".png"), 2, 2, PNG_FORMAT_GRAY,
                          {number, 0, 0, 255});
    std::ofstream(folder_ / "about.txt") << "no picture";
    const OpenedImage stack = open_picture_stack(folder_.path(), spacing_mm);
    EXPECT_FALSE(stack.is_coloured);
    EXPECT_EQ(stack.image.size_voxels, glm::ivec3(2, 2, 4));
    EXPECT_EQ(stack.image.spacing_mm, spacing_mm);
    EXPECT_THAT(stack.image.notes,
                ElementsAre(HasSubstr(testing::sides_are_a_guess), HasSubstr("'plane1.png'")));
    const std::vector<float> all = values();
    EXPECT_THAT((std::vector<float>{all[0], all[4], all[8], all[12]}),
                ElementsAre(1.0F, 9.0F, 10.0F, 100.0F));
    EXPECT_EQ(all[3], 255.0F);
}

TEST(PictureOrder, IsThatOfNumbersAndSaysWhereOneIsMissing) {
    const auto sorted = [](std::vector<std::filesystem::path> names) {
        sort_by_numbers(names);
        return names;
    };
    EXPECT_THAT(sorted({"s_1.png", "s_-2.png", "s_0.png", "s_-10.png"}),
                ElementsAre("s_-10.png", "s_-2.png", "s_0.png", "s_1.png"));
    EXPECT_THAT(sorted({"b-2.png", "B-1.png", "a-3.png"}), ElementsAre("a-3.png", "B-1.png", "b-2.png"));
    EXPECT_THAT(sorted({"a (10).png", "a.png", "a (2).png"}),
                ElementsAre("a.png", "a (2).png", "a (10).png"));
    EXPECT_THAT(sorted({"s0.png", "s-2.png", "s1.png", "s-10.png", "s-1.png"}),
                ElementsAre("s-10.png", "s-2.png", "s-1.png", "s0.png", "s1.png"));
    EXPECT_THAT(sorted({"z10.25.png", "z10.5.png", "z9.75.png", "z10.png", "z-0.5.png", "z-0.25.png"}),
                ElementsAre("z-0.5.png", "z-0.25.png", "z9.75.png", "z10.png", "z10.25.png", "z10.5.png"));
    EXPECT_THAT(sorted({"v1.10.png", "v1.9.png", "v1.8.png"}),
                ElementsAre("v1.8.png", "v1.9.png", "v1.10.png"))
        << "which count";
    EXPECT_THAT(sorted({"1.2.25.png", "1.2.3.png"}), ElementsAre("1.2.3.png", "1.2.25.png"));
    EXPECT_EQ(doubt_of_order({"z0.5.png", "z0.75.png", "z1.png", "z1.25.png", "z1.5.png"}), "");
    EXPECT_THAT(doubt_of_order({"z0.5.png", "z0.75.png", "z1.25.png", "z1.5.png"}),
                HasSubstr("'z0.75.png' is followed by 'z1.25.png', where most names differ by 0.25"));
    EXPECT_EQ(doubt_of_order({"s-2.png", "s-1.png", "s0.png", "s1.png"}), "");
    EXPECT_EQ(doubt_of_order({"s010.png", "s020.png", "s030.png"}), "");
    EXPECT_EQ(doubt_of_order({"apple.png", "pear.png", "plum.png"}), "") << "not numbered at all";
    EXPECT_THAT(doubt_of_order({"s1.png", "s2.png", "s4.png", "s5.png"}),
                HasSubstr("'s2.png' is followed by 's4.png'"));
    EXPECT_THAT(doubt_of_order({"s1.png", "s2.png", "s2 copy.png", "s3.png", "s4.png", "s5.png"}),
                HasSubstr("'s2.png' is followed by 's2 copy.png'"));
}

TEST_F(PictureStackFolder, OfTiffHasAllLevelsAndAllPages) {
    write_tiff_pages<std::uint16_t>(folder_ / "a1.tif", 3, 4, {std::vector<std::uint16_t>(12, 65535)});
    write_tiff_pages<std::uint16_t>(folder_ / "a2.TIFF", 3, 4,
                                    {std::vector<std::uint16_t>(12, 300), std::vector<std::uint16_t>(12, 7)});
    const std::vector<float> all = values();
    ASSERT_EQ(all.size(), 36U);
    EXPECT_THAT((std::vector<float>{all[11], all[12], all[35]}), ElementsAre(65535.0F, 300.0F, 7.0F));
    EXPECT_EQ(open_picture_stack(folder_ / "a2.TIFF", spacing_mm).image.size_voxels.z, 2);
}

TEST_F(PictureStackFolder, OfTiffFindsAPageFromTheOneBeforeAndFromAnyOther) {
    std::vector<std::vector<std::uint8_t>> pages;
    for (std::uint8_t page = 0; page < 200; ++page) pages.emplace_back(4, page);
    write_tiff_pages<std::uint8_t>(folder_ / "a.tif", 2, 2, pages);
    TiffPages tiff(folder_ / "a.tif");
    ASSERT_EQ(tiff.count(), 200);
    for (const int page : {0, 1, 2, 2, 150, 151, 7, 199, 0})
        EXPECT_EQ(tiff.read(page, ImagePurpose::scan).values.front(), static_cast<float>(page));
    EXPECT_THROW((void)tiff.read(200, ImagePurpose::scan), ImagingError);
}

TEST_F(PictureStackFolder, OfTiffIsAsItsTagsSay) {
    const std::vector<std::vector<std::uint16_t>> pages(2, {1, 2, 3, 4});
    const auto first_page = [&](const TiffTags& tags, ImagePurpose purpose = ImagePurpose::scan) {
        write_tiff_pages<std::uint16_t>(folder_ / "a.tif", 2, 2, pages, tags);
        std::vector<float> all = values_of(open_picture_stack(folder_ / "a.tif", spacing_mm, purpose));
        all.resize(4);
        return all;
    };
    const auto refused = [&](const TiffTags& tags) -> std::string {
        return testing::message_of<ImagingError>([&] { (void)first_page(tags); });
    };
    EXPECT_THAT(first_page({.orientation = ORIENTATION_BOTLEFT}), ElementsAre(3, 4, 1, 2));
    EXPECT_THAT(first_page({.orientation = ORIENTATION_TOPRIGHT}), ElementsAre(2, 1, 4, 3));
    EXPECT_THAT(first_page({.orientation = ORIENTATION_BOTRIGHT}), ElementsAre(4, 3, 2, 1));
    EXPECT_THAT(refused({.orientation = ORIENTATION_LEFTTOP}), HasSubstr("rows and columns are exchanged"));
    EXPECT_THAT(first_page({.photometric = PHOTOMETRIC_MINISWHITE}), ElementsAre(65534, 65533, 65532, 65531));
    EXPECT_THAT(first_page({.photometric = PHOTOMETRIC_MINISWHITE}, ImagePurpose::labels),
                ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(first_page({.description = "ImageJ=1.53t\nimages=2\nc0=-32768.0\nc1=1.0\n"}),
                ElementsAre(-32767, -32766, -32765, -32764));
    EXPECT_THAT(refused({.description = "<OME><Pixels SizeC=\"2\" SizeZ=\"1\"></OME>"}), "")
        << "an axis by another name";
    std::filesystem::remove(folder_ / "a.tif");
    write_tiff_pages<std::uint16_t>(folder_ / "b.tif", 2, 2,
                                    std::vector<std::vector<std::uint16_t>>(4, {1, 2, 3, 4}),
                                    {.description = "ImageJ=1.53t\nimages=4\nchannels=2\nslices=2\n"});
    EXPECT_THAT(refusal(), HasSubstr("its 4 pages are of 2 channels"));
    write_tiff_pages<std::uint16_t>(folder_ / "b.tif", 2, 2, {{1, 2, 3, 4}},
                                    {.description = "ImageJ=1.53t\nimages=4\nslices=4\n"});
    EXPECT_THAT(refusal(), HasSubstr("says that it holds 4 slices and has one page"));
}

TEST_F(PictureStackFolder, OfColoursIsALabelMap) {
    // Bone, the facial nerve, black, and red that is not seen.
    const std::vector<std::uint8_t> rgba{255, 249, 219, 255, 244, 214, 49, 255, 0, 0, 0, 255, 255, 0, 0, 0};
    for (const char* name : {"s0.png", "s1.png"})
        write_png_picture(folder_ / name, 2, 2, PNG_FORMAT_RGBA, rgba);
    Segmentation read = read_segmentation(folder_.path(), spacing_mm);
    ASSERT_EQ(read.segments.size(), 2U);
    EXPECT_EQ(read.segments[0].name, "#f4d631");
    name_segments(read, {{40, {"Bone", {255, 249, 219}}}, {41, {"Facial Nerve", {244, 214, 49}}}});
    EXPECT_EQ(read.segments[0].name, "Facial Nerve");
    EXPECT_EQ(read.segments[1].colour_rgb, (std::array<std::uint8_t, 3>{255, 249, 219}));
    EXPECT_EQ(read.labels.at(0, {0, 0, 1}), segment_named(read, "Bone").label);
    EXPECT_EQ(read.labels.at(0, {1, 0, 1}), segment_named(read, "Facial_Nerve").label);
    EXPECT_EQ(read.labels.at(0, {0, 1, 1}), 0);
    EXPECT_EQ(read.labels.at(0, {1, 1, 1}), 0);
}

TEST_F(PictureStackFolder, IsRefusedInOneLineWhereItIsNone) {
    EXPECT_THAT(refusal(), HasSubstr("is no stack of pictures"));
    EXPECT_THROW(open_picture_stack(folder_.path(), std::nullopt), ImagingError);
    const std::vector<std::uint8_t> grey(16, 5);
    write_png_picture(folder_ / "1.png", 4, 4, PNG_FORMAT_GRAY, grey);
    EXPECT_THAT(refusal(), HasSubstr("is no stack of pictures"));
    write_png_picture(folder_ / "2.png", 2, 8, PNG_FORMAT_GRAY, grey);
    EXPECT_THAT(refusal(), HasSubstr("2.png: is of 2 x 8 pixels, grey; the first of its stack is of 4 x 4"));
    std::ofstream(folder_ / "2.png", std::ios::binary) << "no PNG at all";
    EXPECT_THAT(refusal(), HasSubstr("2.png: cannot be read as PNG"));
    write_png_picture(folder_ / "2.png", 4, 4, PNG_FORMAT_GRAY, grey);
    std::filesystem::resize_file(folder_ / "2.png", std::filesystem::file_size(folder_ / "2.png") - 20);
    EXPECT_THAT(refusal(), HasSubstr("2.png: cannot be read as PNG"));
    std::ofstream(folder_ / "2.png", std::ios::trunc).close();
    EXPECT_THAT(refusal(), HasSubstr("2.png: cannot be read as PNG"));
    std::ofstream(folder_ / "3.tif") << "II*";
    EXPECT_THAT(refusal(), HasSubstr("3.tif: cannot be read as TIFF"));
}

TEST_F(PictureStackFolder, IsNoneWhereAPictureLiesBesideAScan) {
    EXPECT_FALSE(is_picture_folder(folder_.path(), true));
    write_png_picture(folder_ / "1.png", 1, 1, PNG_FORMAT_GRAY, {0});
    EXPECT_TRUE(is_picture_folder(folder_.path(), false));
    for (const char* name : {"Thumbs.db", ".DS_Store", "._1.png"})
        std::ofstream(folder_ / name) << "of the desktop";
    EXPECT_TRUE(is_picture_folder(folder_.path(), false));
    write_png_picture(folder_ / "2.png", 1, 1, PNG_FORMAT_GRAY, {0});
    std::ofstream(folder_ / "scan.log") << "of the scanner";
    EXPECT_TRUE(is_picture_folder(folder_.path(), false)) << "most are pictures";
    std::ofstream(folder_ / "IM0001") << "DICM";
    EXPECT_FALSE(is_picture_folder(folder_.path(), false));
    EXPECT_TRUE(is_picture_folder(folder_.path(), true));
    EXPECT_FALSE(is_picture_folder(folder_ / "nowhere", true));
}

TEST(StackSpacing, IsThreeLengths) {
    EXPECT_EQ(parse_stack_spacing("0.192,0.2,1e-1"), glm::dvec3(0.192, 0.2, 0.1));
    for (const char* text :
         {"", "1", "1,2", "1,2,3,4", "1,2,0", "1,2,-3", "1,2,x", "1;2;3", "nan,1,1", "inf,1,1", "1,2,3 "})
        EXPECT_THROW(parse_stack_spacing(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace osteomill
