// A check of the sources: files are opened to write only in the places below, and every program checks,
// before it accepts its command line, that no output would overwrite an input.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace osteomill::testing {
namespace {

using ::testing::IsEmpty;
namespace fs = std::filesystem;

const std::vector<std::string> source_folders{"analysis",      "bridge",  "common",    "devices",
                                              "haptic_server", "imaging", "python",    "render_client",
                                              "slicer",        "studies", "simulation"};

/// Calls `visit` with each source, named from the root on, and its text.
void for_each_source(const std::function<void(const std::string& file, const std::string& text)>& visit) {
    for (const std::string& folder : source_folders)
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(REPOSITORY) / folder)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".cpp" && ending != ".h" && ending != ".py") continue;
            std::ifstream in(entry.path());
            visit(fs::relative(entry.path(), REPOSITORY).string(),
                  std::string(std::istreambuf_iterator<char>(in), {}));
        }
}

/// The sources that open a file to write, replace or make one, each with the reason why that does not bypass
/// atomic_file.h.
const std::map<std::string, std::string> openings{
    {"common/files/atomic_file.cpp", "the place: refuses a link that leads to nothing"},
    {"common/files/session_file.cpp", "moves the part of a killed session aside"},
    {"common/files/output_place.cpp", "a lock of its own name"},
    {"common/recording/packet_writer.cpp", "the part of a SessionFile"},
    {"analysis/logs/csv_log.cpp", "the part of a SessionFile"},
    {"analysis/hdf5/hdf5_file.cpp", "the part of an AtomicFile"},
    {"analysis/replay/recording_sound.cpp", "the part of an AtomicFile"},
    {"imaging/case/bone_import.cpp", "a new folder of a random name"},
    {"imaging/resampling/scratch_values.cpp", "a file without a name"},
    {"imaging/dicom/quiet_libraries.cpp", "/dev/null"},
    {"render_client/ui/view/picture_export.cpp", "a list in a new folder of a free name"},
    {"render_client/ui/start/start_page.cpp", "a new folder of a random name"},
    {"python/osteomill/part_files.py", "its own cases, through no link, appended and locked"},
    {"python/osteomill/studies/program.py", "/dev/null"},
};

TEST(WrittenFiles, AreOpenedInThePlacesThatAreListed) {
    const std::regex opening(R"(std::ofstream[ (]|std::fstream|fopen\([^)]*"[wa]|O_WRONLY|O_RDWR|O_CREAT|)"
                             R"(H5Fcreate|sf_open|SFM_WRITE|pcap_dump_fopen|sqlite3_open|fs::rename|)"
                             R"(filesystem::rename|renameat|copy_file|mkdtemp|mkstemp|resize_file|freopen|)"
                             R"(open\([a-z_]*, "[aw])");
    std::vector<std::string> others;
    std::vector<std::string> found;
    for_each_source([&](const std::string& file, const std::string& text) {
        const bool is_header_of_list = file == "render_client/ui/view/picture_export.h";
        if (!std::regex_search(text, opening) || is_header_of_list) return;
        found.push_back(file);
        if (!openings.contains(file) && !file.starts_with("python/examples/")) others.push_back(file);
    });
    EXPECT_THAT(others, IsEmpty()) << "write through AtomicFile, or say here why not";
    for (const auto& [file, why] : openings)
        EXPECT_TRUE(std::ranges::find(found, file) != found.end()) << file << " opens nothing: " << why;
}

TEST(WrittenFiles, AreHeldAgainstWhatIsReadByEveryCommandLine) {
    // The first two take no command line in, but help others to.
    const std::vector<std::string> writes_nothing{
        "common/program/command_line.cpp", "common/program/option_checks.h", "slicer/slicer_options.cpp"};
    std::vector<std::string> others;
    int command_lines = 0;
    for_each_source([&](const std::string& file, const std::string& text) {
        if (!file.ends_with(".cpp") && !file.ends_with(".h")) return;
        if (text.find("parse_or_text(app") == std::string::npos &&
            text.find("parse_arguments(app") == std::string::npos)
            return;
        ++command_lines;
        if (text.find("require_distinct") == std::string::npos &&
            std::ranges::find(writes_nothing, file) == writes_nothing.end())
            others.push_back(file);
    });
    EXPECT_THAT(others, IsEmpty()) << "call require_distinct (common/files/distinct_files.h)";
    EXPECT_GE(command_lines, 7);
}

/// A binding of Python that is given a path to write hands it to one of these, which call require_distinct.
TEST(WrittenFiles, AreHeldAgainstWhatIsReadByTheModuleOfPython) {
    const std::map<std::string, std::string> places{
        {"analysis/hdf5/recording_hdf5.cpp", "Recording.to_hdf5"},
        {"haptic_server/session/session_assembly.cpp", "Session(record=)"},
    };
    std::vector<std::string> asking;
    for_each_source([&](const std::string& file, const std::string& text) {
        if (places.contains(file) && text.find("require_distinct(files)") != std::string::npos)
            asking.push_back(file);
    });
    EXPECT_EQ(asking.size(), places.size()) << "call require_distinct (common/files/distinct_files.h)";
}

}  // namespace
}  // namespace osteomill::testing
