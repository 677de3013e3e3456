#include "common/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/message_of.h"

namespace osteomill {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string error_of(const std::string& text) {
    return testing::message_of<SceneError>([&] { (void)parse_scene(text, "my.toml"); });
}

const std::string smallest = "name = \"a\"\n[bone]\nphantom = \"tooth\"\n";

TEST(SceneFile, NeedsOnlyANameAndABone) {
    const Scene scene = parse_scene(smallest, "my.toml");
    EXPECT_EQ(scene.name, "a");
    EXPECT_EQ(std::get<PhantomSource>(scene.bone).name, "tooth");
    EXPECT_EQ(scene.burrs.size(), 6U);
    EXPECT_NEAR(scene.burrs[5].spindle_rev_per_s, 10'000.0 / 60.0, 1e-12);
    EXPECT_EQ(scene.stiffness, default_stiffness_relation());
}

TEST(SceneFile, ReadsEveryKey) {
    const Scene scene = parse_scene(R"(
name = "jaw"
description = "A jaw"
start_burr = "round"
[bone]
file = "jaw.nrrd"
threshold_hu = 250
[stiffness]
knots = [[100, 0.5], [2000, 2]]
[[tissues]]
label = 4
name = "enamel"
colour = "#0a0Bff"
protected = true
[[burrs]]
name = "flame"
diameter_mm = 1
[[burrs]]
name = "round"
diameter_mm = 2.5
edges = 8
rpm = 60000
cutting_coefficients_n_per_mm2 = [1, 2, 3]
edge_coefficients_n_per_mm = [0.5, 0.25, 0]
turns = "counter-clockwise"
shank = [[1.2, 0.4], [10, 0.5]]
run_out_mm = 0.05
[device]
rotation = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
scale = 0.5
offset_mm = [1, 2, 3]
[start_pose]
position_mm = [4, 5, 6]
spindle_axis = [0, 3, 4]
[trajectory]
file = "path.csv"
)",
                                    "my.toml", "/scenes");
    const auto& file = std::get<FileSource>(scene.bone);
    EXPECT_EQ(file.path, "/scenes/jaw.nrrd");
    EXPECT_EQ(file.threshold_hu, 250.0);
    EXPECT_EQ(scene.stiffness.knots.size(), 2U);
    EXPECT_EQ(scene.tissues[0].colour_rgb, (std::array<std::uint8_t, 3>{0x0a, 0x0b, 0xff}));
    EXPECT_TRUE(scene.tissues[0].is_protected);
    EXPECT_EQ(scene.description, "A jaw");
    EXPECT_EQ(scene.start_burr, 1U);
    EXPECT_DOUBLE_EQ(scene.burrs[1].spindle_rev_per_s, 1000.0);
    EXPECT_EQ(scene.burrs[1].sigma(), 1.0);
    EXPECT_EQ(scene.burrs[1].cutting_coefficients_n_per_mm2, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(scene.burrs[1].edge_coefficients_n_per_mm, glm::dvec3(0.5, 0.25, 0.0));
    EXPECT_FALSE(scene.burrs[0].has_edge_force()) << "the published law is the default";
    EXPECT_EQ(scene.burrs[1].shank, (ShankProfile{{1.2, 0.4}, {10.0, 0.5}}));
    EXPECT_TRUE(scene.burrs[0].shank.empty());
    EXPECT_EQ(scene.burrs[1].run_out_mm, 0.05);
    EXPECT_EQ(scene.burrs[0].run_out_mm, Burr{}.run_out_mm);
    EXPECT_EQ(scene.device.rotation * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0))
        << "rows, not columns";
    EXPECT_EQ(scene.start_pose.spindle_axis, glm::dvec3(0.0, 0.6, 0.8));
    EXPECT_EQ(std::get<std::filesystem::path>(scene.trajectory.source), "/scenes/path.csv");
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
}

TEST(SceneFile, ShippedScenesAreReadAndSurviveWriting) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(REPOSITORY "/scenes")) {
        if (entry.path().extension() != ".toml" || entry.path().filename() == "materials.toml") continue;
        const Scene scene = read_scene(entry.path());
        EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene) << entry.path();
        ++scenes;
    }
    EXPECT_GE(scenes, 3);
}

TEST(SceneFile, AnUnknownKeyIsRefusedWithItsLineAndTheChoices) {
    EXPECT_THAT(
        error_of(smallest + "[trajectory]\nmotion = \"hold\"\nspeed = 3\n"),
        AllOf(HasSubstr("my.toml:6: unknown key 'speed' in [trajectory]"), HasSubstr("speed_mm_per_s")));
    EXPECT_THAT(error_of("nmae = \"x\"\n" + smallest),
                HasSubstr("my.toml:1: unknown key 'nmae' in the scene"));
    EXPECT_THAT(error_of(smallest + "[[burrs]]\nname = \"b\"\ndiameter_mm = 1\nteeth = 6\n"),
                HasSubstr("my.toml:7: unknown key 'teeth' in [[burrs]]"));
}

TEST(SceneFile, OfALaterVersionIsRefusedBeforeItsKeysAreLookedAt) {
    EXPECT_THAT(error_of("name = 'a'\nnew_key = 1\nneeds = '99.1'\n[bone]\nphantom = 'cube'\n"),
                HasSubstr("my.toml:3: needs Osteomill 99.1 or later, this is "));
    EXPECT_EQ(parse_scene("name = 'a'\nneeds = '0.3'\n[bone]\nphantom = 'cube'\n", "my.toml").name, "a");
}

TEST(SceneFile, ATissueTakesItsStrengthFromAMaterialOrItsOwnNumbers) {
    const std::string tissue = smallest + "[[tissues]]\nlabel = 4\nname = \"x\"\ncolour = \"#ffffff\"\n";
    EXPECT_FALSE(parse_scene(tissue, "my.toml").tissues[0].strength) << "as the CT numbers say";
    const Scene preset = parse_scene(tissue + "material = \"enamel\"\n", "my.toml");
    EXPECT_EQ(preset.tissues[0].strength->material, "enamel");
    EXPECT_NEAR(preset.tissues[0].strength->relative_stiffness, 690.0 / 230.0, 1e-12);
    EXPECT_EQ(stiffness_of(preset).tissues, (std::vector<TissueStiffness>{{4, 690.0 / 230.0}}));
    const Scene own = parse_scene(tissue + "relative_stiffness = 2\nrelative_edge = 0.5\n", "my.toml");
    EXPECT_EQ(own.tissues[0].strength, (TissueStrength{"", 2.0, 0.5}));
    EXPECT_EQ(parse_scene(tissue + "relative_stiffness = 2\n", "my.toml").tissues[0].strength->relative_edge,
              2.0);
    const Scene changed = parse_scene(tissue + "material = \"enamel\"\nrelative_stiffness = 2\n", "my.toml");
    EXPECT_EQ(changed.tissues[0].strength,
              (TissueStrength{"enamel", 2.0, preset.tissues[0].strength->relative_edge}));
    for (const Scene& scene : {preset, own, changed})
        for (const SceneText extent : {SceneText::concise, SceneText::complete})
            EXPECT_EQ(parse_scene(write_scene(scene, extent), "again.toml"), scene);

    EXPECT_THAT(error_of(tissue + "material = \"glass\"\n"),
                AllOf(HasSubstr("my.toml:8: 'material' is \"glass\"; choose one of: cortical bone"),
                      HasSubstr("enamel")));
    EXPECT_THAT(error_of(tissue + "relative_edge = 1\n"), HasSubstr("goes with 'relative_stiffness'"));
    EXPECT_THAT(error_of(tissue + "relative_stiffness = 9\n"), HasSubstr("'relative_stiffness' is 9"));
}

TEST(SceneFile, AProtectedTissueShowsThroughThinBoneUnlessItSaysOtherwise) {
    const std::string tissue = smallest + "[[tissues]]\nlabel = 2\nname = \"sinus\"\ncolour = \"#304f88\"\n";
    EXPECT_EQ(parse_scene(tissue, "my.toml").tissues[0].shows_through_mm, 0.0);
    EXPECT_EQ(parse_scene(tissue + "protected = true\n", "my.toml").tissues[0].shows_through_mm, 1.5);
    const Scene own = parse_scene(tissue +
                                      "shows_through_mm = 0.8\nshows_through_strength = 0.5\n"
                                      "identifier = \"#6eb8d1\"\n",
                                  "my.toml");
    EXPECT_EQ(own.tissues[0].shows_through_mm, 0.8);
    EXPECT_EQ(own.tissues[0].shows_through_strength, 0.5);
    EXPECT_EQ(identifier_of(own.tissues[0]), (std::array<std::uint8_t, 3>{0x6e, 0xb8, 0xd1}));
    EXPECT_EQ(own.tissues[0].colour_rgb, (std::array<std::uint8_t, 3>{0x30, 0x4f, 0x88}));
    for (const SceneText extent : {SceneText::concise, SceneText::complete})
        EXPECT_EQ(parse_scene(write_scene(own, extent), "again.toml"), own);
    EXPECT_THAT(error_of(tissue + "shows_through_mm = 4\n"), HasSubstr("'shows_through_mm' is 4"));
    EXPECT_THAT(error_of(tissue + "shows_through_strength = 1.5\n"),
                HasSubstr("'shows_through_strength' is 1.5"));
    EXPECT_THAT(error_of(tissue + "identifier = \"blue\"\n"), HasSubstr("'identifier' must look like"));
}

TEST(SceneFile, ATissueMayHaveAFactorAndMayNotBeCut) {
    const std::string tissue = smallest + "[[tissues]]\nlabel = 4\nname = \"x\"\ncolour = \"#ffffff\"\n";
    EXPECT_TRUE(parse_scene(tissue, "my.toml").tissues[0].is_cuttable);
    const Scene scene = parse_scene(tissue + "stiffness_factor = 1.5\ncuttable = false\n", "my.toml");
    EXPECT_FALSE(scene.tissues[0].is_cuttable);
    EXPECT_EQ(stiffness_of(scene).factors, (std::vector<TissueFactor>{{4, 1.5}}));
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    const Scene harder = parse_scene(tissue + "relative_stiffness = 2\nstiffness_factor = 1.5\n", "my.toml");
    EXPECT_EQ(stiffness_of(harder).tissues, (std::vector<TissueStiffness>{{4, 3.0}}));
    EXPECT_THAT(error_of(tissue + "material = \"enamel\"\nstiffness_factor = 2\n"),
                HasSubstr("'stiffness_factor' times the tissue's relative stiffness 3 must be 0.02 to 5.1"));
    EXPECT_THAT(error_of(tissue + "stiffness_factor = 0\n"), HasSubstr("'stiffness_factor' is 0"));
    EXPECT_THAT(error_of(tissue + "cuttable = 1\n"), HasSubstr("cuttable"));
}

TEST(SceneFile, TwoTissuesHaveTwoNamesAndNoneThatOfASum) {
    const auto with_tissues = [](const std::string& first, const std::string& second) {
        std::string text = "name = \"x\"\n[bone]\nphantom = \"tooth\"\n";
        for (const auto& [label, name] : {std::pair("1", first), std::pair("2", second)})
            text += std::string("[[tissues]]\nlabel = ") + label + "\nname = \"" + name +
                    "\"\ncolour = \"#000000\"\n";
        return text;
    };
    EXPECT_THAT(error_of(with_tissues("dentin", "dentin")), HasSubstr("two tissues are called \"dentin\""));
    EXPECT_THAT(error_of(with_tissues("dentin", "total")), HasSubstr("as reports call a sum"));
    for (const char* text : {"\xff\xfen\0a", "\xfe\xff\0na"})
        EXPECT_THAT(error_of(text), HasSubstr("is text in UTF-16; save it as UTF-8"));
    EXPECT_LT(error_of("name = \"x\"\n" + std::string(100'000, 'k') + " = 1\n").size(), 1000U);
}

TEST(SceneFile, AMisspeltKeyGetsTheNearestOne) {
    EXPECT_THAT(error_of(smallest + "[trajectory]\nmotion = \"hold\"\nspeed = 3\n"),
                AllOf(HasSubstr("did you mean 'speed_mm_per_s'?"), HasSubstr("choose one of: motion, file")));
    EXPECT_EQ(error_of(smallest + "[[burrs]]\nname = \"b\"\ndiameter = 2\n"),
              "my.toml:6: key 'diameter_mm' is missing in [[burrs]]; 'diameter' looks like it");
    EXPECT_EQ(error_of("name = \"a\"\n[bnoe]\nphantom = \"tooth\"\n"),
              "my.toml:2: key 'bone' is missing in the scene; 'bnoe' looks like it");
}

TEST(SceneFile, AMotionThatCannotBeIsRefused) {
    EXPECT_THAT(error_of("start_burr = \"3 mm\"\n" + smallest +
                         "[trajectory]\nmotion = \"cavity\"\nwidth_mm = 2.5\n"),
                HasSubstr("my.toml:7: a hole of 'width_mm' = 2.5 is too narrow for the start burr \"3 mm\""));
    EXPECT_THAT(error_of(smallest + "[trajectory]\nmotion = \"polishing\"\ndepth_mm = 0\n"),
                HasSubstr("my.toml:6: 'depth_mm' is 0"));
    EXPECT_THAT(error_of(smallest + "[trajectory]\nmotion = \"polishing\"\nspeed_mm_per_s = 0\n"),
                HasSubstr("my.toml:6: 'speed_mm_per_s' is 0"));
}

TEST(SceneFile, AnySpindleSpeedSurvivesWriting) {
    for (double rpm = 100.0; rpm < 400'000.0; rpm *= 1.0137) {
        Scene scene = parse_scene(smallest, "my.toml");
        scene.burrs[0].spindle_rev_per_s = rpm / 60.0;
        ASSERT_EQ(parse_scene(write_scene(scene), "again.toml"), scene) << rpm;
    }
}

TEST(SceneFile, IsWrittenWithEveryKeyThatHasAValue) {
    for (const auto& entry : std::filesystem::directory_iterator(REPOSITORY "/scenes")) {
        if (entry.path().extension() != ".toml" || entry.path().filename() == "materials.toml") continue;
        const Scene scene = read_scene(entry.path());
        const std::string text = write_scene(scene, SceneText::complete);
        EXPECT_EQ(parse_scene(text, "again.toml"), scene) << entry.path();
        for (const char* key :
             {"wall_friction = ", "force_scale = ", "knots = ", "cutting_coefficients_n_per_mm2 = ",
              "feed_forward = ", "rotation = ", "spindle_axis = ", "speed_mm_per_s = "})
            EXPECT_THAT(text, HasSubstr(key)) << entry.path();
    }
}

TEST(SceneFile, IsWrittenForPeople) {
    Scene scene = parse_scene("name = \"a \\\"jaw\\\"\"\n[bone]\nfile = \"bone.nrrd\"\n", "my.toml");
    EXPECT_EQ(write_scene(scene),
              "name = \"a \\\"jaw\\\"\"\n\n# The bone, and where its tissues are.\n[bone]\nfile = "
              "\"bone.nrrd\"\n");
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    scene.start_pose.position_mm = {0.3, -1.0 / 3.0, 1e-9};
    scene.tissues = {
        {.label = 200, .name = "nerve", .colour_rgb = {1, 2, 255}, .is_protected = true, .warn_mm = 0.3}};
    const std::string text = write_scene(scene);
    EXPECT_THAT(text, HasSubstr("position_mm = [0.3, -0.3333333333333333, 1e-09]\n"));
    EXPECT_THAT(text,
                HasSubstr("[[tissues]]\nlabel = 200\nname = \"nerve\"\ncolour = \"#0102ff\"\nprotected = "
                          "true\nwarn_mm = 0.3\n"));
    EXPECT_EQ(parse_scene(text, "again.toml"), scene);
}

TEST(SceneFile, AFileCutOffOrDamagedAnywhereIsASceneOrAnErrorWithItsName) {
    const std::string whole = write_scene(read_scene(REPOSITORY "/scenes/tooth.toml"));
    const auto reads_or_refuses = [](const std::string& text) {
        try {
            (void)parse_scene(text, "my.toml");
            return true;
        } catch (const SceneError& error) {
            return std::string_view(error.what()).starts_with("my.toml:") &&
                   std::string_view(error.what()).find('\n') == std::string_view::npos;
        }
    };
    for (std::size_t size = 0; size < whole.size(); size += 7)
        ASSERT_TRUE(reads_or_refuses(whole.substr(0, size))) << "cut off after " << size;
    for (std::size_t place = 0; place < whole.size(); place += 5)
        for (const char damage : {'\0', '\xff', '\n', '"', '[', '9', '-'}) {
            std::string damaged = whole;
            damaged[place] = damage;
            ASSERT_TRUE(reads_or_refuses(damaged)) << static_cast<int>(damage) << " at " << place;
        }
}

TEST(SceneFile, AMissingKeyIsNamed) {
    EXPECT_THAT(error_of("[bone]\nphantom = \"tooth\"\n"), HasSubstr("key 'name' is missing"));
    EXPECT_THAT(error_of("name = \"a\"\n"), HasSubstr("key 'bone' is missing"));
    EXPECT_THAT(error_of(smallest + "[[burrs]]\nname = \"b\"\n"),
                HasSubstr("my.toml:4: key 'diameter_mm' is missing"));
}

TEST(SceneFile, ValuesOutOfRangeOrOfTheWrongTypeAreRefused) {
    EXPECT_THAT(error_of("name = 3\n[bone]\nphantom = \"tooth\"\n"),
                HasSubstr("my.toml:1: 'name' must be a text"));
    EXPECT_THAT(
        error_of("name = \"a\"\n[bone]\nphantom = \"skull\"\n"),
        HasSubstr("my.toml:3: 'phantom' is \"skull\"; choose one of: jaw, mastoid, tooth, cube, head"));
    const std::string burr = smallest + "[[burrs]]\nname = \"b\"\ndiameter_mm = ";
    EXPECT_THAT(error_of(burr + "0.0\n"), HasSubstr("my.toml:6: 'diameter_mm' is 0"));
    EXPECT_THAT(error_of(burr + "nan\n"), HasSubstr("must be a finite number"));
    EXPECT_THAT(error_of(burr + "1\nedges = 0\n"), HasSubstr("'edges' is 0; it must lie within 1 to 64"));
    EXPECT_THAT(error_of(burr + "1\nrpm = -5\n"), HasSubstr("'rpm' is -5"));
    EXPECT_THAT(error_of(burr + "1\ncutting_coefficients_n_per_mm2 = [0, 1, 1]\n"),
                HasSubstr("K_t must be above 0"));
    EXPECT_THAT(error_of(burr + "1\nedge_coefficients_n_per_mm = [0, -1, 0]\n"),
                HasSubstr("my.toml:7: K_te, K_re and K_ae must be at least 0"));
    EXPECT_THAT(error_of(burr + "1\nrun_out_mm = 1\n"), HasSubstr("'run_out_mm' is 1"));
    EXPECT_THAT(error_of(burr + "1\n[[burrs]]\nname = \"b\"\ndiameter_mm = 2\n"),
                HasSubstr("two burrs are called"));
    EXPECT_THAT(error_of(smallest + "[device]\nrotation = [[1,0,0],[0,1,0],[0,0,-1]]\n"),
                HasSubstr("determinant +1"));
    EXPECT_THAT(error_of(smallest + "[device]\nrotation = [[1,0],[0,1]]\n"), HasSubstr("lists of 3"));
    EXPECT_THAT(error_of(smallest + "[start_pose]\nspindle_axis = [0,0,0]\n"), HasSubstr("has no length"));
    EXPECT_THAT(error_of(smallest + "[start_pose]\nposition_mm = [0,0]\n"),
                HasSubstr("three finite numbers"));
    EXPECT_THAT(error_of("start_burr = \"9 mm\"\n" + smallest), HasSubstr("choose one of: 1 mm, 1.5 mm"));
    EXPECT_THAT(error_of(smallest + "[[tissues]]\nlabel = 1\nname = \"x\"\ncolour = \"red\"\n"),
                HasSubstr("#f6f4ec"));
    EXPECT_THAT(error_of(smallest + "[stiffness]\nknots = [[100, 9]]\n"), HasSubstr("outside 0.02 to 5.1"));
    EXPECT_THAT(error_of("name = \"a\"\n[bone]\nphantom = \"tooth\"\nfile = \"x\"\n"),
                HasSubstr("takes either"));
    EXPECT_THAT(error_of("name = \"a\"\nbone = 3\n"), HasSubstr("must be a table"));
    EXPECT_THAT(error_of(smallest + "[trajectory]\nspeed_mm_per_s = 3\n"), HasSubstr("takes either motion"));
}

TEST(SceneFile, MakesForcesOfCuttingLargerForAnArmThatNeedsIt) {
    const Scene scene = parse_scene("force_scale = 2\n" + smallest, "my.toml");
    EXPECT_EQ(scene.force_scale, 2.0);
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    const Burr& own = scene.burrs.front();
    const Burr felt = felt_burrs(scene).front();
    EXPECT_EQ(felt.cutting_coefficients_n_per_mm2, 2.0 * own.cutting_coefficients_n_per_mm2);
    EXPECT_EQ(felt.edge_coefficients_n_per_mm, 2.0 * own.edge_coefficients_n_per_mm);
    EXPECT_THAT(error_of("force_scale = 0\n" + smallest), HasSubstr("'force_scale' is 0"));
}

TEST(SceneFile, SaysWhetherTheCouplingFeedsForward) {
    EXPECT_FALSE(parse_scene(smallest, "my.toml").feed_forward);
    const Scene scene = parse_scene(smallest + "[coupling]\nfeed_forward = true\n", "my.toml");
    EXPECT_TRUE(scene.feed_forward);
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    EXPECT_THAT(error_of(smallest + "[coupling]\nfeed_forward = 1\n"), HasSubstr("true or false"));
    EXPECT_THAT(error_of(smallest + "[coupling]\nstiffness = 1\n"), HasSubstr("stiffness"));
}

TEST(SceneFile, ReadsAndWritesHeadsThatAreNoBall) {
    const auto head = [](const std::string& keys) {
        return parse_scene(smallest + "[[burrs]]\nname = \"b\"\ndiameter_mm = 2\n" + keys, "my.toml");
    };
    EXPECT_TRUE(head("").burrs[0].is_ball());
    EXPECT_EQ(head("shape = \"cylinder\"\nlength_mm = 4\n").burrs[0].head,
              (BurrHead{HeadShape::cylinder, 4.0, 2.0, 2.0}));
    EXPECT_EQ(head("shape = \"cone\"\nlength_mm = 4\ntip_diameter_mm = 0.8\n").burrs[0].head,
              (BurrHead{HeadShape::cone, 4.0, 0.8, 2.0}));
    for (const char* keys : {"shape = \"pear\"\nlength_mm = 4\nneck_diameter_mm = 0.9\n",
                             "shape = \"barrel\"\nlength_mm = 3\n", "shape = \"ball\"\n"}) {
        const Scene scene = head(keys);
        EXPECT_EQ(parse_scene(write_scene(scene), "back.toml").burrs, scene.burrs);
    }
    const auto refused = [](const std::string& keys) {
        return error_of(smallest + "[[burrs]]\nname = \"b\"\ndiameter_mm = 2\n" + keys);
    };
    EXPECT_THAT(refused("shape = \"egg\"\n"), HasSubstr("my.toml:7"));
    EXPECT_THAT(refused("length_mm = 4\n"), HasSubstr("a ball takes 'diameter_mm' alone"));
    EXPECT_THAT(refused("shape = \"cone\"\n"), HasSubstr("'length_mm'"));
    EXPECT_THAT(refused("shape = \"cone\"\nlength_mm = 4\ntip_diameter_mm = 0.2\n"),
                HasSubstr("0.3 to 1 times as wide"));
}

TEST(SceneFile, AShankThatCannotBeIsRefused) {
    const auto refused = [](const std::string& shank) {
        return error_of(smallest + "[[burrs]]\nname = \"b\"\ndiameter_mm = 2\nshank = " + shank + "\n");
    };
    EXPECT_THAT(refused("3"), HasSubstr("my.toml:7: 'shank' must be a list of lists of 2 finite numbers"));
    EXPECT_THAT(refused("[[1, 0.5, 2], [2, 0.5]]"), HasSubstr("lists of 2 finite numbers"));
    EXPECT_THAT(refused("[[1, 0.5], [inf, 0.5]]"), HasSubstr("lists of 2 finite numbers"));
    EXPECT_THAT(refused("[]"), HasSubstr("leave 'shank' out"));
    EXPECT_THAT(refused("[[2, 0.5]]"), HasSubstr("2 to 8 points, not 1"));
    EXPECT_THAT(refused("[[1, 1], [2, 1], [3, 1], [4, 1], [5, 1], [6, 1], [7, 1], [8, 1], [9, 1]]"),
                HasSubstr("2 to 8 points, not 9"));
    EXPECT_THAT(refused("[[1, 0.5], [5, 0.04]]"), HasSubstr("point 1 has a radius outside 0.05 to 30 mm"));
    EXPECT_THAT(refused("[[1, 31], [5, 0.5]]"), HasSubstr("point 0 has a radius outside"));
    EXPECT_THAT(refused("[[0.4, 0.5], [5, 0.5]]"), HasSubstr("point 0 has a height outside"));
    EXPECT_THAT(refused("[[1, 0.5], [201, 0.5]]"), HasSubstr("point 1 has a height outside"));
    EXPECT_THAT(refused("[[5, 0.5], [5, 1]]"), HasSubstr("point 1 does not lie 0.01 mm or more above"));
    EXPECT_THAT(refused("[[5, 0.5], [4, 1]]"), HasSubstr("point 1 does not lie"));
    EXPECT_THAT(refused("[[0.5, 0.2], [1, 0.2]]"), HasSubstr("ends within the burr"));
    EXPECT_EQ(refused("[[0.5, 0.05], [200, 30]]"), "");
}

TEST(SceneFile, WhatIsNotTomlOrNotThereIsRefusedInOneLine) {
    EXPECT_THAT(error_of("name = \"a\"\n[bone\n"), HasSubstr("my.toml:2: not TOML"));
    EXPECT_THAT(error_of("name = \"a\"\n[bone]\nphantom = \"x\\ny\"\n"),
                HasSubstr("'phantom' holds a control character (byte 2 is"));
    EXPECT_THROW((void)read_scene("/no/such/scene.toml"), SceneError);
    EXPECT_THROW((void)read_scene("/"), SceneError);
}

TEST(SceneFile, ReadsAPlanAndWritesItBack) {
    const std::string tissues =
        smallest + "[[tissues]]\nlabel = 7\nname = \"lesion\"\ncolour = \"#543622\"\n[plan]\n";
    const Scene by_tissue = parse_scene(tissues + "tissue = \"lesion\"\nmargin_mm = 0.25\n", "my.toml");
    EXPECT_EQ(by_tissue.plan, (Plan{.region = TissueRegion{"lesion"}, .margin_mm = 0.25}));
    const Scene by_sphere =
        parse_scene(tissues + "sphere = { centre_mm = [1, 2, 3], radius_mm = 4 }\n", "my.toml");
    EXPECT_EQ(by_sphere.plan, (Plan{.region = SphereRegion{{1, 2, 3}, 4.0}}));
    const Scene by_cylinder = parse_scene(
        tissues + "cylinder = { from_mm = [0, 0, 0], to_mm = [0, 0, 5], radius_mm = 2 }\n", "my.toml");
    EXPECT_EQ(by_cylinder.plan, (Plan{.region = CylinderRegion{{0, 0, 0}, {0, 0, 5}, 2.0}}));
    for (const Scene& scene : {by_tissue, by_sphere, by_cylinder})
        EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    EXPECT_FALSE(parse_scene(smallest, "my.toml").plan);

    EXPECT_THAT(error_of(tissues + "tissue = \"nerve\"\n"),
                AllOf(HasSubstr("my.toml:9"), HasSubstr("\"nerve\" is no tissue"), HasSubstr("\"lesion\"")));
    EXPECT_THAT(error_of(tissues), HasSubstr("[plan] takes one of"));
    EXPECT_THAT(
        error_of(tissues + "tissue = \"lesion\"\nsphere = { centre_mm = [1, 2, 3], radius_mm = 4 }\n"),
        HasSubstr("[plan] takes one of"));
    EXPECT_THAT(error_of(tissues + "sphere = { centre_mm = [1, 2, 3], radius_mm = -4 }\n"),
                HasSubstr("radius_mm"));
    EXPECT_THAT(error_of(tissues + "cylinder = { from_mm = [1, 2, 3], to_mm = [1, 2, 3], radius_mm = 1 }\n"),
                HasSubstr("one place"));
    EXPECT_THAT(error_of(tissues + "tissue = \"lesion\"\nmargin = 1\n"), HasSubstr("margin"));
}

TEST(SceneFile, SetsPassMarksForWhatItCanMeasure) {
    const std::string measured = smallest +
                                 "[plan]\nsphere = { centre_mm = [1, 2, 3], radius_mm = 4 }\n"
                                 "[[tissues]]\nlabel = 7\nname = \"nerve\"\ncolour = \"#543622\"\n"
                                 "protected = true\n[pass]\n";
    const Scene scene = parse_scene(measured +
                                        "time_s = 300\nplan_removed_share = 0.9\nplan_excess_mm3 = 2.5\n"
                                        "structure_touches = 0\npeak_force_n = 4\n",
                                    "my.toml");
    EXPECT_EQ(scene.pass, (PassMarks{{"time_s", 300.0},
                                     {"plan_removed_share", 0.9},
                                     {"plan_excess_mm3", 2.5},
                                     {"structure_touches", 0.0},
                                     {"peak_force_n", 4.0}}));
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml"), scene);
    EXPECT_TRUE(parse_scene(smallest, "my.toml").pass.empty());

    EXPECT_THAT(error_of(measured + "time = 300\n"),
                AllOf(HasSubstr("'time'"), HasSubstr("time_s"), HasSubstr("peak_force_n")));
    EXPECT_THAT(error_of(measured + "plan_removed_share = 90\n"), HasSubstr("plan_removed_share"));
    EXPECT_THAT(error_of(smallest + "[pass]\nplan_excess_mm3 = 1\n"), HasSubstr("needs a [plan]"));
    EXPECT_THAT(error_of(smallest + "[pass]\nstructure_touches = 0\n"), HasSubstr("protected = true"));
}

TEST(SceneFile, HasAMotorWhoseSpeedFallsToAStall) {
    EXPECT_FALSE(parse_scene(smallest, "my.toml").motor);
    const Scene scene =
        parse_scene(smallest + "[motor]\nstall_torque_n_mm = 3.0\nsteady_torque_n_mm = 1.0\n", "my.toml");
    EXPECT_EQ(scene.motor, (Motor{.stall_torque_n_mm = 3.0, .steady_torque_n_mm = 1.0}));
    EXPECT_EQ(parse_scene(write_scene(scene), "again.toml").motor, scene.motor);
    EXPECT_EQ(speed_share_under(*scene.motor, 0.0), 1.0);
    EXPECT_EQ(speed_share_under(*scene.motor, 1.0), 1.0);
    EXPECT_EQ(speed_share_under(*scene.motor, 2.0), 0.5);
    EXPECT_EQ(speed_share_under(*scene.motor, 3.0), 0.0);
    EXPECT_EQ(speed_share_under(*scene.motor, 9.0), 0.0);
    for (const char* wrong :
         {"[motor]\n", "[motor]\nstall_torque_n_mm = 0\n", "[motor]\nstall_torque_n_mm = 1\nrpm = 3\n",
          "[motor]\nstall_torque_n_mm = 1\nsteady_torque_n_mm = 1\n"})
        EXPECT_THROW(parse_scene(smallest + wrong, "my.toml"), SceneError) << wrong;
}

}  // namespace
}  // namespace osteomill
