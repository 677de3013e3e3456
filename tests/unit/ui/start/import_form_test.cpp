#include "render_client/ui/start/import_form.h"

#include <gmock/gmock.h>

#include "common/bone/grid.h"

namespace osteomill {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

TEST(ImportForm, OfLabelsInPicturesNamesTheirColoursSpacingAndMaterials) {
    const ImportForm form{.scan = "[fivrs]",
                          .are_labels = true,
                          .colours = "fivrs.ctbl",
                          .stack_spacing = "0.2,0.2,0.2",
                          .segments = {{.name = "Bone=hard", .material = "enamel"},
                                       {.name = "Dura", .is_protected = true, .warn_mm = 2.5}},
                          .region = {.low_mm = {-1.0, 0.0, 0.0}, .high_mm = {1.0, 2.0, 3.0}},
                          .spacing_mm = 0.25};
    EXPECT_THAT(look_command("bone_import", form, "look.raw"),
                ElementsAre("bone_import", "--labels=[fivrs]", "--colours=fivrs.ctbl",
                            "--stack-spacing=0.2,0.2,0.2", "--preview", "look.raw"));
    EXPECT_THAT(
        import_command("bone_import", form, "case"),
        ElementsAre("bone_import", "--labels=[fivrs]", "--colours=fivrs.ctbl", "--stack-spacing=0.2,0.2,0.2",
                    "--case", "case", "--region=-1.00,0.00,0.00,1.00,2.00,3.00", "--spacing-mm=0.25",
                    "--material=Bone=hard=enamel", "--protect=Dura=2.5"));
}

TEST(ImportForm, OfAScanLeavesMaterialsToItsNumbers) {
    const ImportForm form{.scan = "ct", .segmentations = {"s.seg.nrrd"}, .segments = {{.name = "Nerve"}}};
    EXPECT_THAT(
        import_command("bone_import", form, "case"),
        IsSupersetOf({"ct", "--segmentation=s.seg.nrrd", "--threshold-hu=300", "--keep-soft-tissue"}));
}

TEST(ImportForm, SetsWhatASessionHasToReachWhereItCanBeMissed) {
    ImportForm form{.scan = "ct", .segments = {{.name = "Nerve"}}};
    form.description = "Left ear, 54 years.";
    form.pass = {{"time_s", 300.0}, {"plan_removed_share", 0.9}, {"structure_touches", 0.0}};
    const auto command = [&] { return import_command("bone_import", form, "case"); };
    EXPECT_THAT(command(), IsSupersetOf({"--description=Left ear, 54 years.", "--pass=time_s=300"}));
    EXPECT_THAT(command(), Not(Contains(HasSubstr("plan_removed_share")))) << "there is no target";
    EXPECT_THAT(command(), Not(Contains(HasSubstr("structure_touches")))) << "nothing is protected";
    form.segments.front().is_target = true;
    EXPECT_THAT(command(), Contains("--pass=plan_removed_share=0.9"));
    form.segments.front().is_protected = true;
    EXPECT_THAT(command(), Contains("--pass=structure_touches=0"));
}

TEST(ImportForm, LeavesOutSmallPartsOnlyWhereThatIsTicked) {
    ImportForm form{.scan = "ct"};
    EXPECT_THAT(import_command("bone_import", form, "case"), Not(Contains("--leave-out-specks")));
    form.leaves_out_specks = true;
    EXPECT_THAT(import_command("bone_import", form, "case"), Contains("--leave-out-specks"));
}

TEST(ImportForm, SaysWhatSmallPartsWereFoundWithoutTheNamesOfOptions) {
    EXPECT_EQ(specks_said("bone_import: ct: 3 files of no image were skipped\n"), "");
    EXPECT_EQ(specks_said("bone_import: a: b: 7 parts of bone of less than 2 mm3, 4.1 mm3 in all, touch "
                          "nothing else; --leave-out-specks leaves them out\nbone_import: wrote case\n"),
              "loose parts of bone of less than 2 mm³ each: 7, 4.1 mm³ in all, kept");
    EXPECT_EQ(specks_said("ct: 1 part of bone of less than 2 mm3, 0.5 mm3 in all, touches nothing else; "
                          "left out\n"),
              "loose parts of bone of less than 2 mm³ each: 1, 0.5 mm³ in all, left out");
}

TEST(ImportForm, RefusesAThresholdThatNothingReaches) {
    ImportForm form;
    for (const double most_hu : {1400.0, 3071.0}) {
        const ScanPreview look{.covers = {}, .least_hu = 1400.0, .most_hu = most_hu};
        for (const double threshold_hu : {-1024.0, 300.0, 3071.0}) {
            form.threshold_hu = threshold_hu;
            EXPECT_EQ(wrong_with_threshold(form, look), "") << threshold_hu;
        }
        form.threshold_hu = 9000.0;
        EXPECT_THAT(wrong_with_threshold(form, look), HasSubstr("choose one of at most 3071"));
    }
    const ScanPreview look{.covers = {}, .least_hu = -1024.0, .most_hu = 8000.0};
    form.threshold_hu = 7000.0;
    EXPECT_EQ(wrong_with_threshold(form, look), "") << "of a scan in other units";
    form.threshold_hu = 9000.0;
    EXPECT_THAT(wrong_with_threshold(form, look), HasSubstr("choose one of at most 8000"));
    form.are_labels = true;
    EXPECT_EQ(wrong_with_threshold(form, look), "") << "their bone is named";
}

TEST(ImportForm, NamesItsFieldsInPlaceOfOptions) {
    EXPECT_EQ(without_options("a.nrrd: take a smaller --region or a larger --spacing-mm; --threshold-hu 3"),
              "a.nrrd: take a smaller region or a larger voxel; HU threshold 3");
}

TEST(ImportForm, OfAWholeHeadBeginsWithAsManyVoxelsAsAMachineHolds) {
    ImportForm form;
    take_look(form, {.covers = {.high_mm = {200.0, 240.0, 220.0}}}, true);
    EXPECT_EQ(form.spacing_mm, 0.4);
    EXPECT_LT(voxels_of(form), usual_voxels);
    EXPECT_NEAR(most_memory_bytes(form), 3.0 * 501 * 601 * 551, 1.0);
    EXPECT_EQ(wrong_with_size(form), "");
    form.spacing_mm = finest_voxel_mm;
    EXPECT_THAT(wrong_with_size(form), HasSubstr("billion voxels; 1.5 are the most"));
    take_look(form, {.covers = {.high_mm = {40.0, 40.0, 30.0}}}, true);
    EXPECT_EQ(form.spacing_mm, 0.1) << "of a jaw, 48 million";
}

TEST(ImportForm, OfASmallRegionIsAsFineAsTheScan) {
    ImportForm form{.region = {.high_mm = {10.0, 10.0, 10.0}}};
    const auto scan_of = [](double finest_voxel_mm) {
        ScanPreview scan{};
        scan.finest_voxel_mm = finest_voxel_mm;
        return scan;
    };
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.0)), 0.1) << "a scan that does not say";
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.4)), 0.1) << "burrs are no coarser";
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.075)), 0.08);
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.03)), 0.03);
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.004)), 0.02);
    form.region.high_mm = {40.0, 40.0, 40.0};
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.03)), 0.07) << "200 million voxels";
    form.available_bytes = std::uint64_t{1} << 30;
    EXPECT_EQ(default_spacing_mm(form, scan_of(0.03)), 0.15) << "45 million, of 1 GiB";
}

TEST(ImportForm, TakesTheTimeToReadTheScanAndThatOfEveryVoxel) {
    const ImportForm form{.region = {.high_mm = {40.0, 40.0, 40.0}}, .spacing_mm = 0.1};
    const ScanPreview look{.covers = {.high_mm = {100.0, 100.0, 100.0}}, .took_s = 3.0};
    const double voxels = 401.0 * 401.0 * 401.0, looked_at = 201.0 * 201.0 * 201.0;
    EXPECT_DOUBLE_EQ(estimated_s(form, look), 3.0 + (voxels - looked_at) / 1.6e7);
    ScanPreview quick = look;
    quick.took_s = 0.1;
    EXPECT_DOUBLE_EQ(estimated_s(form, quick), voxels / 1.6e7) << "nothing is read in less than no time";
}

TEST(ImportForm, KeepsWhatWasChosenOfSegmentsThatAreThereAgain) {
    ImportForm form{.segments = {{.name = "Tooth", .material = "dentine"}, {.name = "Gone"}}};
    take_look(form, {.covers = {.high_mm = {1.0, 1.0, 1.0}}, .segments = {"New", "Tooth"}}, false);
    ASSERT_EQ(form.segments.size(), 2U);
    EXPECT_EQ(form.segments[0].name, "New");
    EXPECT_EQ(form.segments[1].material, "dentine");
}

}  // namespace
}  // namespace osteomill
