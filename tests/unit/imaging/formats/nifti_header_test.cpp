#include "haptic_server/imaging/formats/nifti_header.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "haptic_server/imaging/imaging_error.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::nifti_header_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::nifti;
using testing::nifti2;
using testing::write_bytes;

NiftiHeader parse(const std::string& bytes) {
    return parse_nifti_header({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "x.nii");
}

std::string refusal(const std::string& bytes) {
    try {
        parse(bytes);
    } catch (const ImagingError& error) {
        return error.what();
    }
    return "accepted";
}

std::string spoiled(std::string bytes, std::size_t offset, auto value) {
    testing::put(bytes, offset, value);
    return bytes;
}

TEST(NiftiHeader, SaysWhatVoxelsThereAreInEitherVersion) {
    for (const std::string& bytes : {nifti(), nifti2()}) {
        const NiftiHeader header = parse(bytes);
        EXPECT_TRUE(header.voxels_follow);
        EXPECT_THAT(header.sizes, ElementsAre(3u, 4u, 5u));
        EXPECT_EQ(header.voxel_bytes, 120u);
        EXPECT_EQ(header.voxels_begin, bytes.size() - 120);
        EXPECT_THAT(header.spacing_mm, ElementsAre(2.0, 2.0, 2.0));
    }
}

TEST(NiftiHeader, RefusesWhatCannotBe) {
    EXPECT_THAT(refusal(nifti().substr(0, 300)), HasSubstr("cut off"));
    EXPECT_THAT(refusal(std::string(600, '\0')), HasSubstr("cut off or damaged"));
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
    EXPECT_THAT(refusal(spoiled(nifti(), 80, 0.0F)), HasSubstr("above 0"));
    EXPECT_THAT(refusal(spoiled(nifti(), 84, NAN)), HasSubstr("pixdim"));
    EXPECT_THAT(refusal(spoiled(nifti(), 88, 1e-9F)), HasSubstr("pixdim"));
    EXPECT_THAT(refusal(spoiled(nifti(), 116, INFINITY)), HasSubstr("scl_inter"));
    EXPECT_THAT(refusal(spoiled(nifti(), 300, NAN)), HasSubstr("sform"));
    EXPECT_THAT(refusal(spoiled(nifti(), 292, 1e30F)), HasSubstr("sform"));
    EXPECT_THAT(refusal(spoiled(nifti(), 280, 0.0F)), HasSubstr("spacing of its sform"));
    EXPECT_EQ(refusal(spoiled(nifti(), 256, NAN)), "accepted") << "a quaternion that nobody asks for";
    EXPECT_THAT(refusal(spoiled(spoiled(nifti(), 256, NAN), 252, std::int16_t{1})), HasSubstr("qform"));
}

TEST(NiftiHeader, FindsItsVoxelsInAFileBeside) {
    testing::TemporaryFolder folder;
    const auto refused = [&](const char* name) -> std::string {
        try {
            require_room(open_nifti(folder / name).data);
        } catch (const ImagingError& error) {
            return error.what();
        }
        return "accepted";
    };
    std::string header = testing::with(nifti(), "n+1", "ni1").substr(0, 348);
    testing::put(header, 108, 0.0F);
    write_bytes(folder / "x.hdr", header);
    EXPECT_THAT(refused("x.hdr"), HasSubstr("x.img, is missing"));
    write_bytes(folder / "x.img", std::string(119, '\0'));
    EXPECT_THAT(refused("x.hdr"), HasSubstr("x.img: is cut off: 119 of 120"));
    write_bytes(folder / "x.img", std::string(120, '\0'));
    EXPECT_EQ(refused("x.hdr"), "accepted");
    EXPECT_EQ(refused("x.img"), "accepted");
    write_bytes(folder / "x.img.gz", testing::deflated(std::string(120, '\0')));
    EXPECT_THAT(refused("x.hdr"), HasSubstr("which is meant?"));
    write_bytes(folder / "y.nii", header);
    EXPECT_THAT(refused("y.nii"), HasSubstr("not called .hdr"));
}

}  // namespace
}  // namespace osteomill::nifti_header_test
