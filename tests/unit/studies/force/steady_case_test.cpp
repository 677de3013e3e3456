#include "studies/force/steady_case.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"

namespace osteomill::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SteadyCaseFile : public ::testing::Test {
  protected:
    SteadyCaseFile() {
        std::ifstream good(REPOSITORY "/tests/data/milling_forces.json");
        cases_ = nlohmann::json::parse(good);
    }

    std::vector<SteadyCase> read(const std::string& text) const {
        std::ofstream(file_) << text;
        return read_steady_cases(file_);
    }

    /// Refused in one line that names the file and says all of `parts`.
    template <typename... Parts>
    void expect_refused(const std::string& text, const Parts&... parts) const {
        try {
            read(text);
            ADD_FAILURE() << "was read: " << text;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(),
                        AllOf(HasSubstr(file_.string()), Not(HasSubstr("\n")), HasSubstr(parts)...));
        }
    }

    testing::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "cases.json";
    nlohmann::json cases_;
};

TEST_F(SteadyCaseFile, IsReadWhole) {
    const auto cases = read_steady_cases(REPOSITORY "/tests/data/milling_forces.json");
    ASSERT_EQ(cases.size(), cases_.size());
    const SteadyCase& first = cases.front();
    EXPECT_EQ(first.name, "polish upright d=0.25");
    EXPECT_EQ(first.burr.diameter_mm, 5.0);
    EXPECT_EQ(first.burr.edges, 6);
    EXPECT_DOUBLE_EQ(first.burr.spindle_rev_per_s, 10'000.0 / 60.0);
    EXPECT_EQ(first.burr.sense, SpindleSense::counter_clockwise);
    EXPECT_EQ(first.burr.cutting_coefficients_n_per_mm2, glm::dvec3(230.0, 40.0, 20.0));
    EXPECT_EQ(first.velocity_mm_per_s, glm::dvec3(6.0, 0.0, 0.0));
    EXPECT_EQ(first.depth_mm, 0.25);
    EXPECT_FALSE(first.previous_groove_mm_higher);
    EXPECT_EQ(first.mean_force_n, glm::dvec3(-0.068998, -0.516342, 0.091863));
    EXPECT_EQ(first.removal_mm3_per_s, 2.194907);
}

TEST_F(SteadyCaseFile, NamesAMissingKeyAndAnUnknownOne) {
    for (const auto& [key, value] : cases_[2].items()) {
        nlohmann::json without = cases_;
        without[2].erase(key);
        expect_refused(without.dump(), "case 3", "'" + key + "' is missing");
    }
    cases_[2]["depth_cm"] = 0.1;
    expect_refused(cases_.dump(), "case 3 'polish upright d=1.0'", "unknown key 'depth_cm'", "depth_mm");
}

TEST_F(SteadyCaseFile, SaysWhatAValueMustBe) {
    const auto with = [&](const std::string& key, const nlohmann::json& value) {
        nlohmann::json changed = cases_;
        changed[1][key] = value;
        return changed.dump();
    };
    expect_refused(with("name", 3), "case 2", "'name' is 3", "a text");
    expect_refused(with("radius_mm", 0), "'radius_mm' is 0", "above 0");
    expect_refused(with("radius_mm", "2.5"), "'radius_mm' is \"2.5\"", "above 0");
    expect_refused(with("velocity_mm_s", {0, 0, 0}), "'velocity_mm_s' is [0,0,0]", "not all 0");
    expect_refused(with("velocity_mm_s", {6, 0}), "three numbers");
    expect_refused(with("spindle_axis", {0, 0, nullptr}), "three numbers");
    expect_refused(with("depth_mm", -0.1), "'depth_mm' is -0.1");
    expect_refused(with("rpm", 0), "'rpm' is 0");
    expect_refused(with("edges", 2.5), "'edges' is 2.5", "whole");
    expect_refused(with("edges", 0), "'edges' is 0", "whole");
    expect_refused(with("K_N_mm2", {230, -40, 20}), "none below 0");
    expect_refused(with("spin", 0.5), "'spin' is 0.5", "-1 (clockwise)");
    expect_refused(with("previous_groove_mm_higher", 0), "null or a number above 0");
    expect_refused(with("mean_force_N", "none"), "three numbers");
    expect_refused(with("removal_mm3_s", -1), "0 or more");
}

TEST_F(SteadyCaseFile, IsRefusedWhereItIsNoListOfCases) {
    expect_refused("[{\"name\": ", "is not JSON", "line 1");
    expect_refused("", "is not JSON");
    expect_refused("{}", "is not an array");
    expect_refused("[]", "holds no case");
    expect_refused("[3]", "case 1", "is not an object");
    try {
        read_steady_cases(folder_ / "nowhere.json");
        ADD_FAILURE() << "read a file that is not there";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("nowhere.json: cannot be read"));
    }
}

}  // namespace
}  // namespace osteomill::study
