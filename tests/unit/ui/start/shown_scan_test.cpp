#include "render_client/ui/start/shown_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>

#include "render_client/ui/start/import_form.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

const ScanBox covers{{-10.0, 20.0, 700.0}, {9.5, 39.5, 729.5}};

TEST(ScanPreview, ReadsWhatAPreviewSays) {
    const auto look = read_scan_preview(
        "of voxels of 9: 40 x 40 x 60 voxels of 0.5 x 0.5 x 0.45 mm become 40 x 40 x 60 of 0.5 mm; about "
        "0.1 GiB of memory\nreading slices\ncovers -10,20,700,9.5,39.5,729.5 (mm, patient LPS: "
        "x0,y0,z0,x1,y1,z1)\n"
        "HU from -1024 to 3071\ngrey from -200 to 1800 HU\nsegment Facial nerve\nsegment Dura\npreview: "
        "x.png\n");
    ASSERT_TRUE(look);
    EXPECT_EQ(look->covers, covers);
    EXPECT_EQ(look->least_hu, -1024.0);
    EXPECT_EQ(look->most_hu, 3071.0);
    EXPECT_EQ(look->black_hu, -200.0);
    EXPECT_EQ(look->white_hu, 1800.0);
    EXPECT_EQ(look->finest_voxel_mm, 0.45);
    EXPECT_EQ(look->segments, (std::vector<std::string>{"Facial nerve", "Dura"}));
    EXPECT_FALSE(read_scan_preview("bone_import: cannot be read\n"));
    EXPECT_FALSE(read_scan_preview("covers 1,2,3 (mm)\n"));
}

TEST(ScanPreview, KnowsWhereTheSlicesAreInThePicture) {
    const auto slices = preview_slices(covers, 0.5);
    EXPECT_EQ(slices[0].size_px, glm::dvec2(40, 40));
    EXPECT_EQ(slices[1].size_px, glm::dvec2(40, 60));
    EXPECT_EQ(slices[1].first_px, glm::dvec2(44, 0));
    EXPECT_EQ(slices[2].first_px, glm::dvec2(88, 0));
}

TEST(ScanPreview, SaysThePatientsDirectionsAtTheEdges) {
    using Letters = std::array<const char*, 4>;
    const auto texts = [](const Letters& letters) {
        return std::vector<std::string>(letters.begin(), letters.end());
    };
    const auto slices = preview_slices(covers, 0.5);
    // Radiologists' view: the patient's right on the left, the face and the crown above.
    EXPECT_EQ(texts(letters_of(slices[0])), (std::vector<std::string>{"R", "L", "A", "P"}));
    EXPECT_EQ(texts(letters_of(slices[1])), (std::vector<std::string>{"R", "L", "S", "I"}));
    EXPECT_EQ(texts(letters_of(slices[2])), (std::vector<std::string>{"A", "P", "S", "I"}));
}

TEST(ScanPreview, OutlinesWhatReachesTheThreshold) {
    const ScanPreview look{.covers = covers, .black_hu = -200.0, .white_hu = 1800.0};
    Picture picture({132, 60});
    // A square of 302 HU in the axial slice.
    const auto set = [&](int x, int y, std::uint8_t grey) {
        std::fill_n(picture.rgb.begin() + (picture.at(x, y) - picture.rgb.data()), 3, grey);
    };
    for (int y = 10; y < 20; ++y)
        for (int x = 10; x < 20; ++x) set(x, y, 64);
    const auto changed = [&](double threshold_hu) {
        const Picture outlined = with_contour(picture, look, 0.5, threshold_hu);
        int count = 0;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 132; ++x)
                if (!std::equal(outlined.at(x, y), outlined.at(x, y) + 3, picture.at(x, y))) {
                    ++count;
                    EXPECT_TRUE(x == 10 || x == 19 || y == 10 || y == 19) << x << ", " << y;
                }
        return count;
    };
    EXPECT_EQ(changed(300.0), 36) << "its edge, a pixel thick";
    EXPECT_EQ(changed(310.0), 0) << "64 of 255 is 302 HU";
    EXPECT_EQ(changed(-250.0), 0) << "all is above";
    EXPECT_EQ(with_contour(picture, {.covers = covers}, 0.5, 300.0), picture) << "HU are not known";
}

TEST(ScanPreview, ShowsTheSlicesThroughAPlace) {
    // 40 x 40 x 60 voxels, of which one line along each axis is white: they meet at voxel (7, 30, 50).
    ScanVoxels voxels{.size = {40, 40, 60}, .greys = std::vector<std::uint8_t>(40 * 40 * 60, 0)};
    const glm::ivec3 meet(7, 30, 50);
    const auto set = [&](int x, int y, int z) {
        voxels.greys[static_cast<std::size_t>(x + 40 * (y + 40 * z))] = 255;
    };
    for (int i = 0; i < 60; ++i) {
        set(std::min(i, 39), meet.y, meet.z);
        set(meet.x, std::min(i, 39), meet.z);
        set(meet.x, meet.y, i);
    }
    const glm::dvec3 place_mm = covers.low_mm + 0.5 * glm::dvec3(meet);
    const auto is_white = [&](const Picture& picture, int x, int y) { return *picture.at(x, y) == 255; };
    const Picture through = picture_of(voxels, covers, 0.5, place_mm);
    EXPECT_EQ(through.size_px, glm::ivec2(128, 60));
    EXPECT_TRUE(is_white(through, 20, 30) && is_white(through, 7, 5)) << "axial: along x and y";
    EXPECT_TRUE(is_white(through, 44 + 20, 59 - 50) && is_white(through, 44 + 7, 3))
        << "coronal: x and z, up";
    EXPECT_TRUE(is_white(through, 88 + 12, 59 - 50) && is_white(through, 88 + 30, 3)) << "sagittal: y and z";
    const Picture beside = picture_of(voxels, covers, 0.5, place_mm + glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_FALSE(is_white(beside, 20, 30));
    EXPECT_TRUE(is_white(beside, 7, 30)) << "where the line along z pierces it";
    EXPECT_EQ(picture_of(voxels, covers, 0.5, glm::dvec3(1e9)),
              picture_of(voxels, covers, 0.5, covers.high_mm));
}

TEST(ScanPreview, OutlinesSegmentsInTheirColours) {
    // The second segment is a cube of 10 voxels from (5, 5, 5) on.
    ScanVoxels voxels{.size = {40, 40, 60},
                      .greys = std::vector<std::uint8_t>(40 * 40 * 60, 100),
                      .segments = std::vector<std::uint8_t>(40 * 40 * 60, 0)};
    for (int z = 5; z < 15; ++z)
        for (int y = 5; y < 15; ++y)
            for (int x = 5; x < 15; ++x) voxels.segments[static_cast<std::size_t>(x + 40 * (y + 40 * z))] = 2;
    const Picture picture = picture_of(voxels, covers, 0.5, covers.low_mm + 0.5 * glm::dvec3(9.0));
    const auto outline = colour_of_segment(1);
    EXPECT_NE(outline, colour_of_segment(0));
    int pixels = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 128; ++x) pixels += std::equal(outline.begin(), outline.end(), picture.at(x, y));
    EXPECT_EQ(pixels, 3 * 36) << "the edge of a square of 10 in each slice";
    EXPECT_EQ(*picture.at(7, 7), 100) << "inside it is as it was";
    const ScanPreview look{.covers = covers, .black_hu = -200.0, .white_hu = 1800.0};
    EXPECT_EQ(with_contour(picture, look, 0.5, 300.0), picture) << "an outline is no edge of bone";
}

TEST(ScanPreview, ReadsTheVoxelsThatBelongToTheScan) {
    const testing::TemporaryFolder folder;
    const auto raw = folder / "look.raw";
    std::ofstream(raw) << std::string(40 * 40 * 60 - 1, 'a') << 'z';
    const ScanVoxels voxels = read_scan_voxels(raw, covers, 0.5);
    EXPECT_EQ(voxels.size, glm::ivec3(40, 40, 60));
    EXPECT_EQ(voxels.greys.front(), 'a');
    EXPECT_EQ(voxels.greys.back(), 'z');
    EXPECT_TRUE(voxels.segments.empty());
    std::ofstream(raw, std::ios::app) << std::string(40 * 40 * 60, '\2');
    EXPECT_EQ(read_scan_voxels(raw, covers, 0.5).segments.back(), 2);
    EXPECT_THROW((void)read_scan_voxels(raw, covers, 0.6), std::runtime_error);
    EXPECT_THROW((void)read_scan_voxels(folder / "none", covers, 0.5), std::runtime_error);
}

TEST(ScanPreview, ADragSetsTheTwoSidesThatItsSliceShows) {
    // Axial: x to the right, y down, half a millimetre a pixel, from the middle of the first.
    auto box = dragged_box(covers, covers, 0.5, {10.5, 4.5}, {20.5, 14.5});
    ASSERT_TRUE(box);
    EXPECT_EQ(box->low_mm, glm::dvec3(-5.0, 22.0, 700.0));
    EXPECT_EQ(box->high_mm, glm::dvec3(0.0, 27.0, 729.5));
    // Coronal: z runs up; dragged from below to above, and beyond the scan.
    box = dragged_box(covers, *box, 0.5, {44 + 30.5, 20.5}, {44 + 10.5, -50.0});
    EXPECT_EQ(box->low_mm, glm::dvec3(-5.0, 22.0, 719.5));
    EXPECT_EQ(box->high_mm, glm::dvec3(5.0, 27.0, 729.5));
    EXPECT_EQ(slice_at(covers, 0.5, {44 + 30.5, 20.5})->through_axis(), 1);
    EXPECT_FALSE(dragged_box(covers, *box, 0.5, {42.0, 5.0}, {60.0, 5.0})) << "between two slices";
    EXPECT_FALSE(dragged_box(covers, *box, 0.5, {5.0, 55.0}, {6.0, 56.0})) << "below the first";
}

TEST(ScanPreview, ABoxIsShownWhereItWasDragged) {
    const glm::dvec2 from(50.5, 12.5), to(70.5, 42.5);
    const auto box = dragged_box(covers, covers, 0.5, from, to);
    const auto corners = box_in_slice(covers, *box, 0.5, preview_slices(covers, 0.5)[1]);
    EXPECT_LT(glm::distance(corners[0], from), 1e-9);
    EXPECT_LT(glm::distance(corners[1], to), 1e-9);
}

TEST(ImportForm, BecomesACommand) {
    ImportForm form{.scan = "/s/head", .name = "head 1"};
    form.region = {{-60.0, 10.0, 730.0}, {-20.0, 50.0, 770.0}};
    form.segmentations = {"/s/a b.seg.nrrd"};
    form.segments = {
        {.name = "Dura", .is_protected = true}, {.name = "Tumour", .is_target = true}, {.name = "x"}};
    const std::vector<std::string> expected{"bone_import",
                                            "/s/head",
                                            "--segmentation=/s/a b.seg.nrrd",
                                            "--case",
                                            "/c/head 1",
                                            "--region=-60.00,10.00,730.00,-20.00,50.00,770.00",
                                            "--spacing-mm=0.1",
                                            "--threshold-hu=300",
                                            "--keep-soft-tissue",
                                            "--protect=Dura=1",
                                            "--target=Tumour"};
    EXPECT_EQ(import_command("bone_import", form, "/c/head 1"), expected);
    EXPECT_NEAR(voxels_of(form), 401.0 * 401.0 * 401.0, 1.0);
    EXPECT_EQ(look_command("bone_import", form, "/t/look.raw"),
              (std::vector<std::string>{"bone_import", "/s/head", "--segmentation=/s/a b.seg.nrrd",
                                        "--preview", "/t/look.raw"}));
    form.are_labels = true;  // which have no HU
    form.segmentations.clear();
    form.segments.clear();
    EXPECT_EQ(import_command("bone_import", form, "/c/head 1"),
              (std::vector<std::string>{"bone_import", "--labels=/s/head", "--case", "/c/head 1", expected[5],
                                        "--spacing-mm=0.1"}));
}

TEST(ImportForm, KeepsWhatWasChosenWhenSegmentsComeOrGo) {
    ImportForm form;
    take_look(form, {.covers = covers, .segments = {"Dura", "Nerve"}}, true);
    EXPECT_EQ(form.region, covers);
    form.segments[1].is_protected = true;
    form.region.low_mm.x = 0.0;
    take_look(form, {.covers = covers, .segments = {"Nerve", "Tumour"}}, false);
    ASSERT_EQ(form.segments.size(), 2U);
    EXPECT_TRUE(form.segments[0].is_protected);
    EXPECT_FALSE(form.segments[1].is_protected);
    EXPECT_EQ(form.region.low_mm.x, 0.0) << "the scan is the same";
}

}  // namespace
}  // namespace osteomill
