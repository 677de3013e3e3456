// haptic_server, osteomill_slicer, and a receiver that imports as seldom as 3D Slicer may.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "imaging/bone_file/bone_of_file.h"
#include "slicer/reduced_bone.h"
#include "tests/support/child_process.h"
#include "tests/support/slicer_receiver.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using ::testing::HasSubstr;

/// A slicer client of the server at `address`, and who receives from it.
struct Viewer {
    Viewer(const std::string& address, std::chrono::milliseconds interval)
        : program({OSTEOMILL_SLICER, "--connect", address, "--port", "0"}), between_imports(interval) {
        const auto port = program.line_after("listening on 127.0.0.1:");
        if (!port) throw std::runtime_error("no port: " + program.err());
        receiver.emplace(std::stoi(*port));
    }
    ChildProcess program;
    std::chrono::milliseconds between_imports;
    std::optional<SlicerReceiver> receiver;
};

/// The saved bone's fractions, in as many voxels as 3D Slicer is sent.
std::vector<std::uint8_t> fractions_of(const std::filesystem::path& file) {
    const ReducedBone reduced(bone_of_file(file, std::nullopt, default_stiffness_relation()).bone);
    return {reduced.values().begin(), reduced.values().end()};
}

/// Strokes over the cube, with the burr lifted between them: a machine so busy that the milling stops for
/// safety goes on with the next.
std::string strokes(const std::filesystem::path& file) {
    std::ofstream out(file);
    out << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n";
    for (int i = 0; i < 1000; ++i) {
        const double y_mm = 3.0 * (i % 8) - 10.0;
        for (const auto& [at_s, x_mm, z_mm, pedal] :
             {std::tuple(0.0, -10.0, 4.0, 0), std::tuple(0.3, -10.0, 4.0, 1), std::tuple(0.9, -10.0, 1.8, 1),
              std::tuple(3.0, 10.0, 1.8, 1), std::tuple(3.6, 10.0, 4.0, 1), std::tuple(3.9, 10.0, 4.0, 0)})
            out << 6.0 * i + at_s << ',' << x_mm << ',' << y_mm << ',' << z_mm << ",0,0,1," << pedal << '\n';
    }
    return file.string();
}

TEST(SlicerProgram, LeavesTheSavedBoneWithReceiversThatImportNowAndThen) {
    const TemporaryFolder folder;
    ChildProcess server({HAPTIC_SERVER, "--scene", "cube", "--listen", "127.0.0.1:0", "--save-bone",
                         folder / "saved.nrrd", "--trajectory", strokes(folder / "strokes.csv")});
    const auto address = server.address();
    ASSERT_TRUE(address) << server.err();
    std::vector<std::unique_ptr<Viewer>> viewers;
    for (const int interval_ms : {5, 300, 3000})
        viewers.push_back(std::make_unique<Viewer>(*address, std::chrono::milliseconds(interval_ms)));
    std::atomic<bool> is_over{false};
    std::atomic<std::size_t> receivers_of_cuts{0};
    std::vector<std::thread> imports;
    for (const auto& viewer : viewers)
        imports.emplace_back([&, &viewer = *viewer] {
            for (bool has_cuts = false; !is_over;) {
                std::this_thread::sleep_for(viewer.between_imports);
                viewer.receiver->import();
                const auto text = viewer.receiver->texts.find("Session");
                if (has_cuts || text == viewer.receiver->texts.end()) continue;
                has_cuts = nlohmann::json::parse(text->second).at("removed_mm3") > 0.5;
                receivers_of_cuts += has_cuts ? 1 : 0;
            }
        });
    EXPECT_TRUE(eventually([&] { return receivers_of_cuts == viewers.size(); }));
    server.send_signal(SIGINT);
    const auto status = server.wait();
    // At rest the whole is sent once more; then nothing is missing with the slowest import.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    std::vector<std::uint8_t> saved;
    if (status == 0) saved = fractions_of(folder / "saved.nrrd");
    is_over = true;
    for (std::thread& import : imports) import.join();
    ASSERT_EQ(status, 0) << server.err();
    EXPECT_LT(*std::min_element(saved.begin(), saved.end()), *std::max_element(saved.begin(), saved.end()));
    for (const auto& viewer : viewers) {
        SlicerReceiver& receiver = *viewer->receiver;
        ASSERT_EQ(receiver.volume.size(), saved.size());
        EXPECT_TRUE(eventually([&] {
            receiver.import();
            return receiver.volume == saved;
        })) << "imported every "
            << viewer->between_imports.count() << " ms; " << viewer->program.err();
        std::printf("every %d ms: %d wholes and %d parts were imported\n",
                    static_cast<int>(viewer->between_imports.count()), receiver.wholes, receiver.parts);
        const auto text = nlohmann::json::parse(receiver.texts.at("Session"));
        EXPECT_GT(text.at("removed_mm3"), 0.0);
        EXPECT_TRUE(receiver.origins_mm.contains("Burr"));
        EXPECT_EQ(receiver.origins_mm.at("Patient"), glm::dvec3(0.0));
        viewer->program.send_signal(SIGTERM);
        EXPECT_EQ(viewer->program.wait(), 0);
    }
}

TEST(SlicerProgram, TakesMarksWhereTheServerTakesThem) {
    ChildProcess server({HAPTIC_SERVER, "--scene", "cube", "--device", "client", "--listen", "127.0.0.1:0",
                         "--duration-s", "600"});
    const auto address = server.address();
    ASSERT_TRUE(address) << server.err();
    Viewer viewer(*address, std::chrono::milliseconds(5));
    ASSERT_TRUE(eventually([&] {
        viewer.receiver->import();
        return viewer.receiver->texts.contains("Session");
    }));
    viewer.receiver->send_string("Pause", "maybe");
    viewer.receiver->send_string("Pause", "1");
    EXPECT_TRUE(eventually([&] {
        viewer.receiver->import();
        return nlohmann::json::parse(viewer.receiver->texts.at("Session")).at("is_paused") == true;
    }));
    viewer.program.read_output();
    EXPECT_THAT(viewer.program.err(), HasSubstr("Pause: is neither 1 nor 0"));
    // Another receiver has the place when the first has left.
    const auto port = viewer.program.out().substr(viewer.program.out().rfind(':') + 1);
    viewer.receiver.reset();
    ASSERT_TRUE(eventually([&] {
        viewer.program.read_output();
        return viewer.program.err().find("the connection to 3D Slicer ends") != std::string::npos;
    }));
    SlicerReceiver second(std::stoi(port));
    EXPECT_TRUE(eventually([&] {
        second.import();
        return second.wholes > 0;
    }));
}

TEST(SlicerProgram, SaysInOneLineWhatIsWrong) {
    const Finished wrong = run_program({OSTEOMILL_SLICER, "--connect", "nowhere"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_EQ(wrong.err,
              "osteomill_slicer: --connect: is 'nowhere', not HOST:PORT with a port from 1 to 65535, such "
              "as 127.0.0.1:7010\n");
    const Viewer viewer("127.0.0.1:1", std::chrono::milliseconds(5));
    const std::string port = viewer.program.out().substr(viewer.program.out().rfind(':') + 1);
    const Finished taken = run_program({OSTEOMILL_SLICER, "--port", port.substr(0, port.find('\n'))});
    EXPECT_EQ(taken.status, 1);
    EXPECT_THAT(taken.err, HasSubstr("cannot listen there: Address already in use"));
    EXPECT_EQ(std::count(taken.err.begin(), taken.err.end(), '\n'), 1);
}

}  // namespace
}  // namespace osteomill::testing
