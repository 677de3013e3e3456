// The real study program, as a user calls it: its files, its messages, its exit status.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using namespace std::string_literals;
using testing::text_of;

constexpr const char* case_file = OSTEOMILL_TEST_DATA "/milling_forces.json";

struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;
};

class StudyProgram : public ::testing::Test {
  protected:
    Outcome run(const std::string& arguments, const std::string& environment = {}) const {
        const std::string command = environment + STUDY " " + arguments + " >'" +
                                    (folder_ / "said").string() + "' 2>'" + (folder_ / "errors").string() +
                                    "' </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "said"),
                text_of(folder_ / "errors")};
    }

    /// Exit status and one line on standard error.
    void expect_refused(const std::string& arguments, int exit_code, const std::string& reason) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
        EXPECT_THAT(outcome.err, StartsWith("osteomill_study: ")) << arguments;
        EXPECT_THAT(outcome.err, HasSubstr(reason)) << arguments;
        EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    }

    testing::TemporaryFolder folder_;
    std::string out_ = (folder_ / "out").string();
};

TEST_F(StudyProgram, RunsTheReferenceCasesWithinTheirBars) {
    const Outcome outcome = run(std::string("force --cases ") + case_file + " --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(out_ + "/cases.json"));
    const auto reports = nlohmann::json::parse(text_of(out_ + "/cases.json"));
    const auto cases = nlohmann::json::parse(text_of(case_file));
    ASSERT_EQ(reports.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto& report = reports[i];
        const std::string name = report.at("name");
        EXPECT_EQ(name, cases[i].at("name").get<std::string>());
        EXPECT_EQ(report.at("file").at("mean_force_N"), cases[i].at("mean_force_N"));
        // The bars of an upright 5 mm burr deeper than three voxels, and of any other motion.
        const bool easy = cases[i].at("radius_mm") == 2.5 && cases[i].at("depth_mm") > 0.3 &&
                          cases[i].at("spindle_axis").at(2) == 1.0 &&
                          cases[i].at("previous_groove_mm_higher").is_null() &&
                          cases[i].at("velocity_mm_s").at(2) == 0;
        EXPECT_LT(report.at("error_percent"), easy ? 1.0 : 2.0) << name;
        EXPECT_LT(report.at("file_error_percent"), easy ? 1.0 : 2.0) << name;
        EXPECT_LT(report.at("removal_error_percent"), 2.0) << name;
        EXPECT_GE(report.at("step_us").at("p99"), report.at("step_us").at("p50")) << name;
        EXPECT_GT(report.at("step_us").at("p50"), 0.0) << name;
        if (easy) {
            EXPECT_LT(report.at("ripple_percent"), 2.0) << name;
        }
    }
}

TEST_F(StudyProgram, CutsAsItIsTold) {
    const auto cases = nlohmann::json::parse(text_of(case_file));
    std::ofstream(folder_ / "one.json") << nlohmann::json::array({cases.at(2)});
    const Outcome outcome = run("force --cases " + (folder_ / "one.json").string() + " --out " + out_ +
                                " --voxel-mm 0.2 --milling-rate-hz 1000 --travel-mm 0.6");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto report = nlohmann::json::parse(text_of(out_ + "/cases.json")).at(0);
    EXPECT_EQ(report.at("voxel_mm"), 0.2);
    EXPECT_EQ(report.at("milling_rate_hz"), 1000.0);
    EXPECT_EQ(report.at("steps"), 100);
    EXPECT_NEAR(report.at("travel_mm"), 0.6, 1e-9);
}

TEST_F(StudyProgram, DrawsItsChartsQuickly) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "what it runs is run by the unit tests; under a sanitizer it takes minutes";
#endif
    const Outcome outcome = run("force --quick --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(out_)) << "says where the files are";
    EXPECT_THAT(outcome.err, HasSubstr("cases 100 %\n"));
    const auto found = nlohmann::json::parse(text_of(out_ + "/force.json"));
    EXPECT_LT(found.at("random").at("median_error_percent"), 1.0);
    for (const char* chart : {"curves", "contact"})
        EXPECT_THAT(text_of(out_ + "/" + chart + ".svg"), HasSubstr("</svg>")) << chart;
}

TEST_F(StudyProgram, PolishesQuickly) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sessions are run by the unit tests; under a sanitizer these take minutes";
#endif
    const Outcome outcome = run("polishing --quick --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(out_)) << "says where the files are";
    EXPECT_THAT(outcome.err, HasSubstr("cases 100 %\n"));
    const auto numbers_of = [&](const std::string& run) {
        std::istringstream lines(text_of(out_ + "/figures.csv"));
        std::string line;
        while (std::getline(lines, line) && !line.starts_with(run)) {
        }
        std::istringstream cells(line.substr(std::min(run.size(), line.size())));
        std::vector<double> numbers;
        for (std::string cell; std::getline(cells, cell, ',');)
            numbers.push_back(std::strtod(cell.c_str(), nullptr));
        return numbers;
    };
    // Reached the end; slide, s; depth, stray, mm; mean force, limit cycle, N; depth at which it begins, mm;
    // faults.
    const auto implicit = numbers_of("milling,implicit,1000,");
    ASSERT_EQ(implicit.size(), 8u);
    EXPECT_EQ(implicit[0], 1.0);
    EXPECT_NEAR(implicit[1], 7.6, 0.5);
    EXPECT_NEAR(implicit[2], 3.5, 0.1);
    EXPECT_LT(implicit[5], 0.2) << "steady";
    EXPECT_EQ(implicit[7], 0.0);
    const auto published = numbers_of("milling,interpolate,100,");
    ASSERT_EQ(published.size(), 8u);
    EXPECT_GT(published[5], 0.2) << "chatters";
    for (const char* chart : {"depth", "milling", "point_spring"})
        EXPECT_THAT(text_of(out_ + "/polishing_" + chart + ".svg"), HasSubstr("</svg>")) << chart;
}

TEST_F(StudyProgram, DrawsAndMeasuresPicturesQuickly) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "what it runs is run by the unit tests; under a sanitizer it takes minutes";
#endif
    const Outcome outcome = run("render --quick --out " + out_);
    if (outcome.err.find("OpenGL") != std::string::npos)
        GTEST_SKIP() << "needs OpenGL without a display: " << outcome.err;
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto found = nlohmann::json::parse(text_of(out_ + "/render.json"));
    EXPECT_THAT(outcome.out, HasSubstr(found.at("gl_renderer").get<std::string>()));
    int defaults = 0;
    for (const auto& point : found.at("accuracy")) {
        EXPECT_GT(point.at("frame_ms"), 0.0);
        if (!point.at("is_default")) continue;
        ++defaults;
        EXPECT_GE(point.at("psnr_db"), 40.0);
    }
    EXPECT_EQ(defaults, 1);
    EXPECT_THAT(text_of(out_ + "/render_accuracy.svg"), HasSubstr("</svg>"));
}

TEST_F(StudyProgram, MeasuresTheFullRateOfWhatDraws) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "what it runs is run by the unit tests; under a sanitizer it takes minutes";
#endif
    const Outcome outcome = run("render --full-rate --frames 1 --size-px 160x90 --out " + out_);
    if (outcome.err.find("no OpenGL") != std::string::npos)
        GTEST_SKIP() << "needs OpenGL without a display: " << outcome.err;
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto found = nlohmann::json::parse(text_of(out_ + "/full_rate.json"));
    const std::string renderer = found.at("gl_renderer");
    EXPECT_EQ(outcome.out.find("no GPU: a software rasteriser draws") != std::string::npos,
              found.at("is_software_renderer").get<bool>());
    int of_window = 0;
    for (const auto& row : found.at("rows")) {
        EXPECT_GT(row.at("p99_ms"), 0.0) << row;
        EXPECT_EQ(row.at("gl_renderer"), renderer);
        ++of_window;
    }
    EXPECT_EQ(of_window, 8) << "two bones: orbit, carve, two ways of stereo";
    const auto& head = found.at("bones").at("head");
    EXPECT_EQ(head.at("times_coarser"), 1) << "the bone itself";
    EXPECT_LE(head.at("texture_bytes"), 629u << 20U) << "what a graphics card has to have for a whole head";
    EXPECT_THAT(text_of(out_ + "/render_full_rate.svg"), HasSubstr("</svg>"));
    expect_refused("render --gpu 63 --full-rate --out " + out_, 1, "GPU 63: EGL lists ");
    expect_refused("render --full-rate --size-px wide --out " + out_, 2, "'wide', not WIDTHxHEIGHT");
    expect_refused("render --size-px 160x90 --out " + out_, 2, "--full-rate");
}

TEST_F(StudyProgram, CalibratesBoneAndFoam) {
    const Outcome outcome = run("calibrate " OSTEOMILL_TEST_DATA "/calibration_runs.csv --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto found = nlohmann::json::parse(text_of(out_ + "/calibration.json"));
    ASSERT_EQ(found.size(), 2u);
    // The coefficients that the table was made with.
    const double known[2][6] = {{230.0, 40.0, 20.0, 0.5, 0.8, 0.1}, {30.0, 8.0, 4.0, 0.05, 0.1, 0.02}};
    for (std::size_t material = 0; material < 2; ++material)
        for (std::size_t i = 0; i < 6; ++i) {
            const auto& coefficient = found[material].at("coefficients").at(i);
            EXPECT_NEAR(coefficient.at("value"), known[material][i],
                        3.0 * coefficient.at("standard_uncertainty").get<double>())
                << coefficient;
        }
    EXPECT_THAT(text_of(out_ + "/scene.toml"), HasSubstr("edge_coefficients_n_per_mm = ["));
    EXPECT_THAT(text_of(out_ + "/residuals.csv"), HasSubstr("\n48,foam,2,up,3,"));
    for (const char* chart : {"fit", "residuals"})
        EXPECT_THAT(text_of(out_ + "/calibration_" + chart + ".svg"), HasSubstr("</svg>")) << chart;
}

TEST_F(StudyProgram, ChoosesRunsForACalibrationThatCannotBeFittedEmpty) {
    const Outcome outcome =
        run("calibrate --design --runs 6 --diameters-mm 4 --tilts-deg 0,30 --rpm 20000 --out " + out_);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("one factor at a time:"));
    expect_refused("calibrate " + out_ + "/design.csv --out " + out_, 1,
                   "design.csv:2: force_feed_n is ''; it must be a number");
    expect_refused("calibrate --out " + out_, 2, "a table of runs, or --design");
    expect_refused("calibrate nowhere.csv --out " + out_, 1, "nowhere.csv: cannot be read");
    expect_refused("calibrate nowhere.csv --seed 2", 2, "--design");
}

// Studies that measure no times.
TEST_F(StudyProgram, JoinsTheBytesOfOneProcessFromParts) {
    for (const std::string& study :
         {"stability --rails 5 --seed 3"s, "stability --sites --quick --only 'plate of 1 mm'"s,
          "calibrate " OSTEOMILL_TEST_DATA "/calibration_runs.csv"s, "calibrate --design --runs 6"s}) {
        const std::string name = std::to_string(std::hash<std::string>()(study));
        const std::string whole = (folder_ / ("whole" + name)).string();
        const std::string parts = (folder_ / ("parts" + name)).string();
        const std::string joined = (folder_ / ("joined" + name)).string();
        const Outcome of_one = run(study + " --out " + whole);
        ASSERT_EQ(of_one.exit_code, 0) << study << of_one.err;
        for (const char* const part : {"1/2", "2/2"})
            ASSERT_EQ(run(study + " --shard " + part + " --out " + parts).exit_code, 0) << study;
        const std::string first_word = study.substr(0, study.find(' '));
        const Outcome of_parts = run(first_word + " --merge " + parts + " --out " + joined);
        ASSERT_EQ(of_parts.exit_code, 0) << study << of_parts.err;
        for (const auto& entry : std::filesystem::directory_iterator(whole))
            EXPECT_EQ(text_of(joined / entry.path().filename()), text_of(entry.path()))
                << study << ": " << entry.path();
    }
}

TEST_F(StudyProgram, IsRepeatedFromTheManifestOfItsFolder) {
    ASSERT_EQ(run("stability --rails 2 --seed 3 --out " + out_).exit_code, 0);
    const auto manifest = nlohmann::json::parse(text_of(out_ + "/manifest.json"));
    EXPECT_EQ(manifest.at("command"), (std::vector<std::string>{"stability", "--rails", "2", "--seed", "3"}));
    EXPECT_EQ(manifest.at("settings").at("--seed"), "3");
    EXPECT_FALSE(manifest.at("settings").at("--jobs").get<std::string>().empty()) << "not given";
    const Outcome repeated = run("repeat " + out_);
    EXPECT_EQ(repeated.exit_code, 0) << repeated.out << repeated.err;
    EXPECT_THAT(repeated.out, HasSubstr("columns are as they were"));

    auto kept = nlohmann::json::parse(text_of(out_ + "/rails.json"));
    kept.at("implicit").at("cases") = 3;
    std::ofstream(out_ + "/rails.json") << kept;
    const Outcome of_another = run("repeat " + out_);
    EXPECT_EQ(of_another.exit_code, 1);
    EXPECT_THAT(of_another.out, HasSubstr("rails.json: /implicit/cases: cells that differ: 1, by up to 1; "));
    expect_refused("repeat " + (folder_ / "nowhere").string(), 1, "manifest.json: cannot be read");
    auto hostile = nlohmann::json::parse(text_of(out_ + "/manifest.json"));
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"sessions", "/"},
          {"stability", "--quick", "sessions", "/"},
          {"stability", "--rails", "2", "--out=elsewhere"},
          {"stability", "--rails", "2", "--quick", "bridge"},
          {"stability", "--database", "postgresql://elsewhere/\x1b[2J"}}) {
        hostile.at("command") = command;
        std::ofstream(out_ + "/manifest.json") << hostile;
        expect_refused("repeat " + out_, 1, "names no study that can be repeated");
    }
    expect_refused("stability --rails 2 bridge", 2, "bridge");
}

TEST_F(StudyProgram, RefusesDeepJsonOfAFolderThatItRepeats) {
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    std::filesystem::create_directory(out_);
    std::ofstream(out_ + "/manifest.json") << deep;
    expect_refused("repeat " + out_, 1, "manifest.json: its lists and objects lie more than");
    std::ofstream(out_ + "/manifest.json")
        << R"({"command": ["stability", "--rails", "2"], "version": "0", "commit": "0"})";
    std::ofstream(out_ + "/rails.json") << deep;
    expect_refused("repeat " + out_, 1, "rails.json: its lists and objects lie more than");
}

TEST_F(StudyProgram, WritesOverNoFileThatItReads) {
    std::filesystem::create_directory(out_);
    std::filesystem::copy_file(case_file, out_ + "/cases.json");
    const std::string before = text_of(out_ + "/cases.json");
    expect_refused("force --cases " + out_ + "/cases.json --out " + out_, 2,
                   "--out and --cases are the same");
    EXPECT_EQ(text_of(out_ + "/cases.json"), before);
}

TEST_F(StudyProgram, SaysInOneLineWhatIsWrong) {
    expect_refused("force --cases nowhere.json --out " + out_, 1, "nowhere.json: cannot be read");
    std::ofstream(folder_ / "bad.json") << "[{\"name\": \"half a case\"}]";
    expect_refused("force --cases " + (folder_ / "bad.json").string() + " --out " + out_, 1,
                   "case 1 'half a case': 'radius_mm' is missing");
    std::ofstream(folder_ / "file") << "in the way";
    expect_refused(std::string("force --cases ") + case_file + " --out " + (folder_ / "file/out").string(), 1,
                   "file/out: cannot be made a folder");
    expect_refused(
        "", 2,
        "a study to run: force, tradeoff, choose, stability, arms, polishing, render, realtime, bridge, "
        "states, calibrate, sessions, assist or repeat");
    expect_refused("farce", 2, "farce");
    expect_refused("realtime --quick --duration-s 60", 2, "--duration-s");
    expect_refused(std::string("force --cases ") + case_file + " --voxel-mm 0", 2, "--voxel-mm");
    expect_refused("force --case x.json", 2, "--case");
    expect_refused("stability --shard 3/2", 2, "'3/2' is no part I/N with 1 <= I <= N");
    expect_refused("stability --methods hold,glue", 2, "glue");
    expect_refused("stability --delays 7", 2, "7");
    expect_refused("stability --merge a --quick", 2, "--merge");
}

TEST_F(StudyProgram, HasHelpAndAVersion) {
    const Outcome help = run("force --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("--voxel-mm"));
    EXPECT_THAT(help.out, HasSubstr("(0.1)"));
    EXPECT_EQ(run("--version").exit_code, 0);
}

}  // namespace
}  // namespace osteomill
