// The documents are correct: links lead somewhere, paths exist, and the programs have the options that
// commands use.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "common/scene/scene_file.h"
#include "common/scene/scene_keys.h"
#include "tests/support/child_process.h"
#include "tests/support/document_checks.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::filesystem::path repository_folder = REPOSITORY;

std::string text_in_repository(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(repository_folder / file).rdbuf();
    return text.str();
}

/// The help of our programs, each asked once. A benchmark is not built for this: its source names its
/// options, and those of the library it uses.
std::string help_of_program(const std::string& program, const std::string& subcommand) {
    static std::map<std::string, std::string> known;
    if (program.ends_with("_benchmark")) {
        std::string source = text_in_repository("tests/benchmarks/" + program + ".cpp");
        if (source.empty()) throw std::runtime_error("there is no program " + program);
        if (source.find("<benchmark/benchmark.h>") != std::string::npos) source += " --benchmark_filter";
        return source;
    }
    const std::filesystem::path file = std::filesystem::path(PROGRAMS) / program;
    if (!std::filesystem::exists(file)) throw std::runtime_error("there is no program " + program);
    const auto [entry, is_new] = known.try_emplace(program + ' ' + subcommand);
    if (is_new) {
        std::vector<std::string> command{file.string()};
        if (!subcommand.empty()) command.push_back(subcommand);
        command.emplace_back("--help");
        const Finished finished = run_program(command);
        if (finished.status != 0) throw std::runtime_error(program + ' ' + subcommand + " is not understood");
        entry->second = finished.out;
    }
    return entry->second;
}

template <typename Check>
Findings findings_in_all(const Check& check) {
    Findings all;
    for (const Document& document : read_documents(repository_folder))
        for (std::string& line : check(document)) all.push_back(std::move(line));
    return all;
}

TEST(Documents, LinkToWhatIsThere) {
    EXPECT_THAT(
        findings_in_all([](const Document& document) { return dead_links(document, repository_folder); }),
        IsEmpty());
}

TEST(Documents, NamePathsThatExist) {
    EXPECT_THAT(findings_in_all([](const Document& document) {
                    // A changelog is about the past.
                    return document.file == "CHANGELOG.md" ? Findings{}
                                                           : dead_paths(document, repository_folder);
                }),
                IsEmpty());
}

TEST(Documents, ShowCommandsThatTheProgramsUnderstand) {
    EXPECT_THAT(
        findings_in_all([](const Document& document) { return bad_commands(document, help_of_program); }),
        IsEmpty());
}

/// A chart is of this version, or in a folder that is named after the one it is of.
TEST(Documents, ShowChartsOfThisVersionOrSayOfWhich) {
    const auto minor = [](const std::string& version) { return version.substr(0, version.rfind('.')); };
    const std::filesystem::path results = repository_folder / "docs/results";
    std::string pages;
    for (const Document& document : read_documents(repository_folder)) pages += document.text;
    int charts = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results)) {
        const std::filesystem::path chart = entry.path().lexically_relative(results);
        if (chart.extension() != ".svg" && chart.filename() != "demo_forces.png") continue;
        SCOPED_TRACE(chart);
        ++charts;
        EXPECT_THAT(pages, HasSubstr(chart.string() + ")")) << "no page shows it";
        std::ifstream file(entry.path().parent_path() / "manifest.json");
        if (!file) {
            ADD_FAILURE() << "it stands beside no manifest";
            continue;
        }
        const auto manifest = nlohmann::json::parse(file);
        EXPECT_TRUE(std::regex_match(manifest.at("commit").get<std::string>(), std::regex("[0-9a-f]{8,40}")));
        const auto drawn_by = minor(manifest.at("version").get<std::string>());
        if (std::isdigit(static_cast<unsigned char>(chart.string().front())) != 0) {
            EXPECT_EQ(*chart.begin(), drawn_by);
            continue;
        }
        EXPECT_EQ(drawn_by, minor(OSTEOMILL_VERSION)) << "draw it anew";
        std::string command = "```bash\nbuild/release/bin/" + manifest.at("program").get<std::string>();
        for (const auto& word : manifest.at("command").get<std::vector<std::string>>()) command += ' ' + word;
        EXPECT_THAT(bad_commands({chart, command + "\n```\n"}, help_of_program), IsEmpty());
    }
    EXPECT_GT(charts, 20);
}

TEST(Documents, BeginWithAShortReadme) {
    EXPECT_LT(std::filesystem::file_size(repository_folder / "README.md"), 8000u);
}

TEST(Documents, NameNoProgramThatTheDemoLeavesUnbuilt) {
    const std::string demo = text_in_repository("demo.sh"), readme = text_in_repository("README.md");
    std::string built;
    const std::regex build("\nbuild release ([^\n]*)"), row("\n\\| `(\\w+)` \\|");
    for (std::sregex_iterator match(demo.begin(), demo.end(), build), end; match != end; ++match)
        built += ' ' + match->str(1) + ' ';
    int programs = 0;
    for (std::sregex_iterator match(readme.begin(), readme.end(), row), end; match != end;
         ++match, ++programs)
        EXPECT_THAT(built, HasSubstr(' ' + match->str(1) + ' '));
    EXPECT_EQ(programs, 7);
}

TEST(Documents, LetTheViewerOfTwoMachinesDrill) {
    const std::string page = text_in_repository("docs/network.md");
    const std::regex server("\nbuild/release/bin/haptic_server[^\n]*--tls-cert[^\n]*");
    std::smatch command;
    ASSERT_TRUE(std::regex_search(page, command, server));
    EXPECT_THAT(command.str(), HasSubstr("--device client"));
    EXPECT_THAT(command.str(), ::testing::Not(HasSubstr("--operators")))
        << "then the client's name is needed, too";
}

TEST(Documents, DescribeEveryMessageAndFieldOfTheProtocol) {
    const std::string page = text_in_repository("docs/protocol.md");
    const auto describes = [&](const std::string& word) {
        return std::regex_search(page, std::regex("\\b" + word + "\\b"));
    };
    const std::regex field("(\\w+) ([a-z]\\w*) = \\d+;");
    for (const char* file : {"bone.proto", "tool.proto", "session.proto"}) {
        const std::string messages = text_in_repository(std::filesystem::path("proto/osteomill/v2") / file);
        for (std::sregex_iterator match(messages.begin(), messages.end(), field), end; match != end; ++match)
            EXPECT_TRUE(describes((*match)[2]) || describes((*match)[1])) << file << ": " << match->str();
    }
}

TEST(Documents, DescribeEveryKeyOfAScene) {
    const std::string page = text_in_repository("docs/scenes.md");
    const std::regex key("([a-z]\\w*) = ");
    // Only values that differ from the defaults are written.
    Scene scene{.name = "all",
                .bone = FileSource{.path = "bone.nrrd", .threshold_hu = 301.0, .segmentation = "s.nrrd"},
                .stiffness = {.knots = {{1.0, 1.0}}},
                .tissues = {},
                .burrs = default_burr_set(1.0),
                .start_burr = 1,
                .wall_friction = 0.3,
                .motor = Motor{.stall_torque_n_mm = 2.0, .steady_torque_n_mm = 1.0},
                .device = {.rotation = glm::dmat3(2.0), .scale = 2.0, .offset_mm = {1.0, 2.0, 3.0}},
                .start_pose = {{1.0, 2.0, 3.0}, {1.0, 0.0, 0.0}},
                .trajectory = {.source = BuiltInTrajectory::cavity,
                               .start_mm = {1.0, 2.0, 3.0},
                               .travel_direction = {0.0, 1.0, 0.0},
                               .speed_mm_per_s = 1.0,
                               .depth_mm = 1.0,
                               .width_mm = 9.0},
                .plan = Plan{.region = TissueRegion{"bone"}, .margin_mm = 9.0}};
    scene.burrs[0] = {.name = "cone",
                      .head = {.shape = HeadShape::cone},
                      .edges = 2,
                      .spindle_rev_per_s = 1.0,
                      .cutting_coefficients_n_per_mm2 = {1.0, 1.0, 1.0},
                      .edge_coefficients_n_per_mm = {1.0, 1.0, 1.0},
                      .sense = SpindleSense::counter_clockwise,
                      .shank = {{0.5, 0.2}, {5.0, 0.2}},
                      .run_out_mm = 0.1};
    Tissue tissue{.label = 1,
                  .name = "bone",
                  .is_protected = true,
                  .strength = TissueStrength{.relative_stiffness = 2.0, .relative_edge = 3.0},
                  .stiffness_factor = 2.0,
                  .is_cuttable = false,
                  .segment = "bone",
                  .opacity = 0.5,
                  .warn_mm = 3.0};
    scene.tissues = {tissue, tissue};
    scene.tissues[1].strength->material = "enamel";
    scene.fixtures = {{.kind = FixtureKind::guide, .is_on = false, .radius_mm = 9.0, .reach_mm = 9.0},
                      {.kind = FixtureKind::guide, .path = PlaneGuide{}},
                      {.kind = FixtureKind::forbidden,
                       .distance_mm = 9.0,
                       .fade_mm = 9.0,
                       .stiffness_n_per_mm = 9.0,
                       .damping_n_s_per_m = 9.0,
                       .max_force_n = 9.0},
                      {.kind = FixtureKind::slow, .spindle_share = 0.5}};
    std::set<std::string> keys{"phantom", "file", "sphere", "cylinder"};  // a scene has only one of these
    const std::string scene_text = write_scene(scene);
    for (std::sregex_iterator match(scene_text.begin(), scene_text.end(), key), end; match != end; ++match)
        keys.insert((*match)[1]);
    EXPECT_GT(keys.size(), 40u);
    for (const std::string& each : keys) EXPECT_THAT(page, HasSubstr("`" + each + "`"));
}

/// Ranges of a scene's keys as the tables of docs/scenes.md write them: five digits and more with a space.
struct Ranges {
    std::map<std::string, std::set<std::string>> of{};
    static std::string as_written(double bound) {
        std::string digits = fmt::format("{}", bound);
        if (digits.size() > 4 && digits.find('.') == std::string::npos) digits.insert(digits.size() - 3, " ");
        return digits;
    }
    void number(const char* key, double, double, const AllowedRange& range) {
        of[key].insert(as_written(range.low) + " to " + as_written(range.high));
    }
    void needed_number(const char* key, double, const AllowedRange& range) { number(key, 0.0, 0.0, range); }
    void rpm(const char* key, double, double, const AllowedRange& range) { number(key, 0.0, 0.0, range); }
    void whole_number(const char* key, int, int, int low, int high) {
        number(key, 0.0, 0.0, {double(low), double(high)});
    }
    void truth(const char* key, bool, bool) { of[key].insert("true"); }
    void vector(const char* key, const glm::dvec3&, const glm::dvec3&) { of[key].insert("["); }
    void place(const char* key, const glm::dvec3&, const glm::dvec3&) { of[key].insert("within 10 000"); }
    void direction(const char* key, const glm::dvec3&, const glm::dvec3&) {
        of[key].insert("length above 0");
    }
    void text(const char* key, const std::string&) { of[key].insert("text"); }
    template <typename Choice, typename Names>
    void choice(const char* key, Choice, Choice, const Names& names) {
        for (const char* name : names) of[key].insert(fmt::format("`\"{}\"`", name));
    }
};

TEST(Documents, GiveTheRangeOfEveryKeyOfAScene) {
    Ranges ranges;
    scene_keys::of_scene(ranges, Scene(), Scene());
    scene_keys::of_tissue(ranges, Tissue(), Tissue());
    scene_keys::of_tissue_under_burr(ranges, Tissue(), Tissue());
    scene_keys::of_burr(ranges, Burr(), Burr());
    scene_keys::of_motor(ranges, Motor());
    scene_keys::of_coupling(ranges, Scene(), Scene());
    scene_keys::of_device(ranges, DeviceMapping(), DeviceMapping());
    scene_keys::of_start_pose(ranges, ToolPose(), ToolPose());
    scene_keys::of_trajectory(ranges, TrajectorySpec(), TrajectorySpec());
    scene_keys::of_plan(ranges, Plan(), Plan());
    scene_keys::of_rating_item(ranges, RatingItem(), RatingItem());
    for (const FixtureKind kind : {FixtureKind::guide, FixtureKind::forbidden, FixtureKind::slow})
        scene_keys::of_fixture(ranges, Fixture{.kind = kind}, Fixture());

    EXPECT_GE(ranges.of.size(), 36u);
    const std::string page = text_in_repository("docs/scenes.md");
    for (const auto& [key, written] : ranges.of) {
        const std::size_t row = page.find("| `" + key + "` |");
        ASSERT_NE(row, std::string::npos) << key;
        const std::string line = page.substr(row, page.find('\n', row) - row);
        for (const std::string& range : written) EXPECT_THAT(line, HasSubstr(range));
    }
}

TEST(DocumentChecks, FindLinksThatLeadNowhere) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "docs");
    std::ofstream(folder.path() / "docs/there.md") << "# A heading, with `code`\n";
    const Document document{
        "docs/page.md",
        "# Here\n[good](there.md#a-heading-with-code) [dead](gone.md) [up](../docs/there.md)\n"
        "[here](#here) [no such](there.md#lost) [web](https://example.org/x)\n"
        "`[code](nothing.md)`\n```\n[block](nothing.md)\n```\n"};
    EXPECT_THAT(dead_links(document, folder.path()),
                ElementsAre(HasSubstr("leads to gone.md,"), HasSubstr("leads to there.md#lost, and")));
}

TEST(DocumentChecks, FindPathsThatAreNoMore) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "common/bone");
    std::filesystem::create_directories(folder.path() / "out");  // a user who has tried the commands has it
    std::ofstream(folder.path() / "common/bone/grid.h") << "";
    const Document document{"page.md",
                            "`common/bone` and `common/gone`, `grid.h` and `lost.h`, `and/or`, "
                            "`out/session.json`, `common/FOLDER`, `--json FILE`\n"
                            "```bash\nls common/bone/grid.h common/bone/grid.cpp  # common/not/read\n```\n"};
    EXPECT_THAT(dead_paths(document, folder.path()),
                UnorderedElementsAre(HasSubstr("common/gone"), HasSubstr("lost.h"),
                                     HasSubstr("common/bone/grid.cpp")));
}

TEST(DocumentChecks, FindOptionsThatAProgramLacks) {
    const auto help = [](const std::string& program, const std::string& subcommand) -> std::string {
        if (program == "osteomill_study") return subcommand == "force" ? "--random INT" : "";
        if (program == "haptic_server") return "  --log-csv FILE\n  --device TEXT";
        throw std::runtime_error("there is no program " + program);
    };
    const Document document{
        "page.md",
        "```bash\nbuild/release/bin/haptic_server --device client --log \\\n    --log-csv=x &\n"
        "sudo build/release/bin/osteomill_study force --random 5 --seed 1    # --comment\n"
        "A=1 build/release/bin/gone --x | cat --y\n```\n"
        "```\nbuild/release/bin/haptic_server --not-bash\n```\n"};
    EXPECT_THAT(bad_commands(document, help), ElementsAre(HasSubstr("haptic_server has no option --log"),
                                                          HasSubstr("osteomill_study has no option --seed"),
                                                          HasSubstr("there is no program gone")));
}

}  // namespace
}  // namespace osteomill::testing
