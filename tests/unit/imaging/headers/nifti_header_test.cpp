#include "imaging/formats/nifti_header.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::nifti_header_test {
namespace {

using ::testing::HasSubstr;
using testing::nifti;
using testing::nifti2;
using testing::write_bytes;

NiftiHeader parse(const std::string& bytes) {
    return parse_nifti_header({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "x.nii");
}

std::string refusal(const std::string& bytes) {
    return testing::message_of<ImagingError>([&] { parse(bytes); });
}

std::string spoiled(std::string bytes, std::size_t offset, auto value) {
    testing::put(bytes, offset, value);
    return bytes;
}

TEST(NiftiHeader, SaysWhatVoxelsThereAreInEitherVersion) {
    for (const std::string& bytes : {nifti(), nifti2()}) {
        const NiftiHeader header = parse(bytes);
        EXPECT_TRUE(header.voxels_follow);
        EXPECT_EQ(header.image.size_voxels, glm::ivec3(3, 4, 5));
        EXPECT_EQ(header.voxel_bytes, 120u);
        EXPECT_EQ(header.byte_skip, static_cast<std::int64_t>(bytes.size()) - 120);
        EXPECT_EQ(header.image.spacing_mm, glm::dvec3(2.0));
    }
}

/// The same image by its qform alone: turned half way round about z.
std::string by_qform() {
    std::string bytes = spoiled(nifti(), 254, std::int16_t{0});
    testing::put(bytes, 252, std::int16_t{1});
    testing::put(bytes, 256, std::array{0.0F, 0.0F, 1.0F, 10.0F, 20.0F, 30.0F});
    return bytes;
}

TEST(NiftiHeader, LiesWhereItsSformSays) {
    for (const std::string& bytes : {nifti(), nifti2()}) {
        const SourceImage image = parse(bytes).image;
        EXPECT_EQ(position_mm(image, glm::dvec3(1.0)), glm::dvec3(-12.0, -22.0, 32.0));
        EXPECT_TRUE(image.notes.empty());
    }
}

TEST(NiftiHeader, LiesWhereItsQformSays) {
    EXPECT_LT(
        glm::distance(position_mm(parse(by_qform()).image, glm::dvec3(1.0)), glm::dvec3(-8.0, -18.0, 32.0)),
        1e-5);
    const std::string mirrored = spoiled(by_qform(), 76, -1.0F);
    EXPECT_LT(
        glm::distance(position_mm(parse(mirrored).image, glm::dvec3(1.0)), glm::dvec3(-8.0, -18.0, 28.0)),
        1e-5);
}

TEST(NiftiHeader, SaysWhereSformAndTheRestDisagree) {
    const SourceImage by_sform = parse(spoiled(nifti(), 88, 1.0F)).image;
    EXPECT_EQ(by_sform.spacing_mm, glm::dvec3(2.0));
    EXPECT_THAT(by_sform.notes.at(0),
                HasSubstr("its sform says voxels of 2 x 2 x 2, its pixdim 2 x 2 x 1; the sform is followed"));
    std::string turned = by_qform();
    testing::put(turned, 254, std::int16_t{1});
    EXPECT_THAT(parse(turned).image.notes.at(0), HasSubstr("turn axis i differently"));
    std::string moved = turned;
    testing::put(moved, 256, std::array{0.0F, 0.0F, 0.0F, 10.0F, 25.0F, 30.0F});
    EXPECT_THAT(parse(moved).image.notes.at(0), HasSubstr("place it 5 apart"));
    const std::string sheared = spoiled(spoiled(nifti(), 284, 0.01F), 88, 1.0F);  // 0.3 degrees
    EXPECT_THAT(refusal(sheared), HasSubstr("its axes i and j are 89.71 degrees apart"));
    EXPECT_THAT(parse(spoiled(nifti(), 284, 0.01F)).image.notes.at(0), HasSubstr("made perpendicular"));
}

TEST(NiftiHeader, SaysWhereItHasNoOrientation) {
    EXPECT_THAT(
        parse(spoiled(nifti(), 254, std::int16_t{0})).image.notes.at(0),
        HasSubstr(std::string(testing::sides_are_a_guess) + " (taken as right-anterior-superior (RAS))"));
}

TEST(NiftiHeader, ConvertsItsUnits) {
    EXPECT_EQ(parse(spoiled(nifti(), 123, std::uint8_t{2 + 8})).image.spacing_mm.x, 2.0);
    EXPECT_EQ(parse(spoiled(nifti(), 123, std::uint8_t{3})).image.spacing_mm.x, 2e-3);
    EXPECT_EQ(parse(spoiled(nifti2(), 500, std::int32_t{3})).image.spacing_mm.x, 2e-3);
    EXPECT_THAT(refusal(spoiled(nifti2(), 500, std::int32_t{1})), HasSubstr("more than 10 m from"))
        << "2 m is too much";
    EXPECT_THAT(refusal(spoiled(nifti(), 123, std::uint8_t{4})), HasSubstr("xyzt_units"));
}

TEST(NiftiHeader, LeavesOutDimensionsOfOneVoxel) {
    for (const std::int16_t last : {std::int16_t{0}, std::int16_t{1}}) {
        const std::string bytes = spoiled(nifti(), 40, std::array<std::int16_t, 6>{5, 3, 4, 5, last, last});
        EXPECT_EQ(parse(bytes).image.size_voxels, glm::ivec3(3, 4, 5));
    }
    EXPECT_THAT(refusal(spoiled(nifti(), 40, std::array<std::int16_t, 5>{4, 3, 4, 5, 2})),
                HasSubstr("4 dimensions"));
    EXPECT_EQ(parse(spoiled(nifti(), 112, NAN)).voxels.slope, 1.0) << "as nibabel writes none";
}

TEST(NiftiHeader, RefusesWhatCannotBe) {
    EXPECT_THAT(refusal(nifti().substr(0, 300)), HasSubstr("cut off"));
    EXPECT_THAT(refusal(std::string(600, '\0')), HasSubstr("is no NIfTI"));
    EXPECT_THAT(refusal(spoiled(nifti(), 40, std::int16_t{-1})), HasSubstr("-1 dimensions"));
    EXPECT_THAT(refusal(spoiled(nifti(), 42, std::int16_t{0})), HasSubstr("an axis of 0"));
    EXPECT_THAT(refusal(spoiled(nifti2(), 24, std::int64_t{1} << 62)), HasSubstr("an axis of"));
    EXPECT_THAT(refusal(spoiled(nifti(), 70, std::int16_t{1})), HasSubstr("datatype 1 of 16 bits"));
    EXPECT_THAT(refusal(spoiled(nifti(), 72, std::int16_t{8})), HasSubstr("datatype 4 of 8 bits"));
    for (const float offset : {-352.0F, 0.0F, 347.0F, 1e30F, NAN, INFINITY})
        EXPECT_THAT(refusal(spoiled(nifti(), 108, offset)), HasSubstr("vox_offset")) << offset;
    EXPECT_THAT(refusal(spoiled(nifti2(), 168, std::int64_t{-1})), HasSubstr("vox_offset"));
}

TEST(NiftiHeader, RefusesNumbersThatNoScanHas) {
    const std::string by_pixdim = spoiled(nifti(), 254, std::int16_t{0});
    EXPECT_THAT(refusal(spoiled(by_pixdim, 80, 0.0F)), HasSubstr("above 0"));
    EXPECT_THAT(refusal(spoiled(by_pixdim, 84, NAN)), HasSubstr("pixdim"));
    EXPECT_THAT(refusal(spoiled(by_pixdim, 88, 1e-9F)), HasSubstr("pixdim"));
    EXPECT_THAT(refusal(spoiled(spoiled(nifti(), 112, 1.0F), 116, INFINITY)), HasSubstr("scl_inter"));
    EXPECT_THAT(refusal(spoiled(nifti(), 300, NAN)), HasSubstr("sform"));
    EXPECT_THAT(refusal(spoiled(nifti(), 292, 1e30F)), HasSubstr("sform"));
    EXPECT_THAT(refusal(spoiled(nifti(), 280, 0.0F)), HasSubstr("spacing of its sform"));
    EXPECT_EQ(refusal(spoiled(nifti(), 256, NAN)), "") << "a quaternion that nobody asks for";
    EXPECT_THAT(refusal(spoiled(spoiled(nifti(), 256, NAN), 252, std::int16_t{1})), HasSubstr("qform"));
}

TEST(NiftiHeader, FindsItsVoxelsInAFileBeside) {
    testing::TemporaryFolder folder;
    const auto refused = [&](const char* name) -> std::string {
        return testing::message_of<ImagingError>(
            [&] { require_room(find_voxels(open_nifti(folder / name), folder / name)); });
    };
    std::string header = testing::with(nifti(), "n+1", "ni1").substr(0, 348);
    testing::put(header, 108, 0.0F);
    write_bytes(folder / "x.hdr", header);
    EXPECT_THAT(refused("x.hdr"), HasSubstr("x.img, is missing"));
    write_bytes(folder / "x.img", std::string(119, '\0'));
    EXPECT_THAT(refused("x.hdr"), HasSubstr("x.img: is cut off: 119 of 120"));
    write_bytes(folder / "x.img", std::string(120, '\0'));
    EXPECT_EQ(refused("x.hdr"), "");
    EXPECT_EQ(refused("x.img"), "");
    write_bytes(folder / "x.img.gz", testing::deflated(std::string(120, '\0')));
    EXPECT_THAT(refused("x.hdr"), HasSubstr("which is meant?"));
    write_bytes(folder / "Z.HDR", header);
    write_bytes(folder / "Z.IMG", std::string(120, '\0'));
    EXPECT_EQ(refused("Z.HDR"), "");
    EXPECT_EQ(refused("Z.IMG"), "");
    write_bytes(folder / "y.nii", header);
    EXPECT_THAT(refused("y.nii"), HasSubstr("not called .hdr"));
}

}  // namespace
}  // namespace osteomill::nifti_header_test
