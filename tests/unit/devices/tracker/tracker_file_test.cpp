#include "devices/tracker/tracker_file.h"

#include <gmock/gmock.h>

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::string tool = "[tool]\nburr_centre_mm = [0, 0, 150]\nspindle_axis = [0, 0, -2]\n";
const std::string pedal = "[pedal]\nstring = 'Pedal'\n";
const std::string points =
    "[[points]]\nname = 'a'\ntracker_mm = [0, 0, 0]\npatient_mm = [5, 5, 5]\n"
    "[[points]]\nname = 'b'\ntracker_mm = [10, 0, 0]\npatient_mm = [15, 5, 5]\n"
    "[[points]]\ntracker_mm = [0, 10, 0]\npatient_mm = [5, 15.3, 5]\n";

TEST(TrackerFile, SaysToolPedalAndPlace) {
    const TrackerSetup setup = parse_tracker_setup(tool + pedal + points, "t.toml");
    EXPECT_EQ(setup.handpiece.burr_centre_mm, glm::dvec3(0.0, 0.0, 150.0));
    EXPECT_EQ(setup.handpiece.spindle_axis, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(setup.handpiece.pedal, "Pedal");
    EXPECT_THAT(residual_line(setup), HasSubstr("registered by 3 points: residual 0.1"));
    EXPECT_TRUE(
        parse_tracker_setup(tool + "[pedal]\nalways = true\n" + points, "t.toml").handpiece.pedal.empty());
}

TEST(TrackerFile, SaysInOneLineWhatIsWrong) {
    for (const auto& [toml, words] :
         {std::pair(pedal + points, "'tool'"), std::pair(tool + points, "'pedal'"),
          std::pair(tool + pedal, "there are 0 of [[points]]"),
          std::pair(tool + pedal + points + "[[points]]\nname = 'd'\ntracker_mm = [0,0,0]\n", "'patient_mm'"),
          std::pair(tool + pedal + points + "colour = 1\n", "colour"),
          std::pair(tool + "[pedal]\n" + points, "takes one of"),
          std::pair(tool + "[pedal]\nalways = true\nstring = 'P'\n" + points, "takes one of"),
          std::pair(tool + "[pedal]\nstring = 'a name of more than twenty letters'\n" + points,
                    "20 characters"),
          std::pair(tool + pedal + "[registration]\nlargest_residual_mm = 0\n" + points,
                    "largest_residual_mm"),
          std::pair(tool + pedal + "[registration]\nlargest_residual_mm = 0.05\n" + points, "mm off"),
          std::pair(
              std::string("[tool]\nburr_centre_mm = [0, 0, 9e9]\nspindle_axis=[0,0,1]\n") + pedal + points,
              "within 1000 mm"),
          std::pair(
              std::string("[tool]\nburr_centre_mm = [0, 0, 9]\nspindle_axis=[0,0,0]\n") + pedal + points,
              "no length"),
          std::pair(std::string("[tool\n"), "t.toml:1")}) {
        try {
            parse_tracker_setup(toml, "t.toml");
            ADD_FAILURE() << words;
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
            EXPECT_THAT(error.what(), HasSubstr("t.toml"));
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(read_tracker_setup("/nowhere.toml"), std::runtime_error);
}

}  // namespace
}  // namespace osteomill
