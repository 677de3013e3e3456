// haptic_server and render_client on two machines: drill, lose the network, find it again, and end with the
// same bone and the same picture as a viewer that lost nothing.
#include "tests/containers/two_machines.h"

#include <gmock/gmock.h>
#include <png.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {
namespace {

using namespace std::chrono_literals;

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json json_of(const std::filesystem::path& file) {
    return nlohmann::json::parse(bytes_of(file));
}

/// Waits until a line about a client has been logged so often.
bool is_said(ChildProcess& server, const std::string& about, const std::string& what, int times) {
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    for (;;) {
        int said = 0;
        std::istringstream log(server.err());
        for (std::string line; std::getline(log, line);)
            if (line.find(about) != std::string::npos && line.ends_with(what)) ++said;
        if (said >= times) return true;
        if (std::chrono::steady_clock::now() > deadline || server.wait(1s)) return false;
    }
}

/// The mean colours of squares of a picture's middle, clear of the panels, which tell of the frame rate and
/// the delay.
std::vector<double> squares_of(const std::filesystem::path& png) {
    constexpr std::size_t edge = 16;
    constexpr std::size_t first_row = 128;
    constexpr std::size_t end_row = first_row + 11 * edge;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, png.c_str()) == 0) return {};
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
    const bool is_read = png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) != 0;
    if (!is_read || image.height < end_row) return {};
    const std::size_t columns = image.width / edge;
    std::vector<double> means(3 * columns * (end_row - first_row) / edge, 0.0);
    for (std::size_t y = first_row; y < end_row; ++y)
        for (std::size_t x = 0; x < columns * edge; ++x)
            for (std::size_t channel = 0; channel < 3; ++channel)
                means[3 * ((y - first_row) / edge * columns + x / edge) + channel] +=
                    static_cast<double>(bytes[3 * (y * image.width + x) + channel]) / (edge * edge);
    return means;
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

class TwoMachinesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
        FoundMachines found = find_machines(folder_.path(), PROGRAMS);
        if (!found.why_none.empty())
            GTEST_SKIP() << "neither containers (" << found.why_no_containers << ") nor namespaces ("
                         << found.why_none << ")";
        machines_ = std::move(found.machines);
        std::cout << "two machines: " << machines_->kind();
        if (!found.why_no_containers.empty())
            std::cout << ", for want of containers: " << found.why_no_containers;
        std::cout << std::endl;
    }

    std::string out(const std::string& name) const { return machines_->folder() + "/" + name; }
    Command viewer(Machine where, const std::string& name) const {
        return machines_->run(where, "render_client",
                              {"--connect", machines_->server_for(where) + ":7010", "--offscreen",
                               "--window-size", "640x480", "--frames", "100000", "--screenshots", out(name),
                               "--screenshot-every", "100000", "--json", out(name + ".json")});
    }

    TemporaryFolder folder_;
    std::unique_ptr<TwoMachines> machines_;
};

TEST_F(TwoMachinesTest, EndWithTheSameBoneAndPictureThoughTheCableWasPulled) {
    constexpr auto longer_than_a_client_bears_silence = 6s;
    // The burr turns in a picture as fast as pictures come, and the first bone sets the view.
    constexpr double largest_difference_of_pictures = 1.0;
    std::ofstream(folder_ / "drilling.csv") << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n"
                                               "0,0.5,0.2,5.5,0,0,1,0\n"
                                               "4,0.5,0.2,5.0,0,0,1,1\n"
                                               "12,0.5,0.2,2.5,0,0,1,1\n"
                                               "90,2.0,0.2,2.5,0,0,1,1\n";
    ChildProcess server(
        machines_->run(Machine::server, "haptic_server",
                       {"--listen", "0.0.0.0:7010", "--insecure-network", "--trajectory", out("drilling.csv"),
                        "--record", out("session.pcap"), "--json", out("server.json")}));
    ASSERT_TRUE(server.line_after("listening on ", 60s)) << server.err();
    ChildProcess steady(viewer(Machine::beside_server, "steady"));
    ChildProcess cut(viewer(Machine::viewer, "cut"));
    const std::string far = "client " + machines_->viewer_address() + ":";
    ASSERT_TRUE(is_said(server, "client 127.0.0.1:", "joined", 1)) << server.err() << steady.err();
    ASSERT_TRUE(is_said(server, far, "joined", 1)) << server.err() << cut.err();
    std::this_thread::sleep_for(2s);  // into the bone
    machines_->pull_cable();
    std::this_thread::sleep_for(longer_than_a_client_bears_silence);
    machines_->plug_cable();
    ASSERT_TRUE(is_said(server, far, "joined", 2)) << server.err() << cut.err();
    std::this_thread::sleep_for(1s);
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(60s), 0) << server.err();
    ASSERT_EQ(steady.wait(60s), 0) << steady.err();
    ASSERT_EQ(cut.wait(60s), 0) << cut.err();

    const auto served = json_of(folder_ / "server.json");
    EXPECT_GT(served.at("removed_mm3").at("total"), 0.1) << "it drilled";
    for (const char* name : {"steady", "cut"}) {
        const auto seen = json_of(folder_ / (std::string(name) + ".json"));
        EXPECT_EQ(seen.at("bone_checksum"), served.at("bone_checksum")) << name;
        EXPECT_EQ(seen.at("checksum_mismatches"), 0) << name;
        EXPECT_GT(seen.at("frames"), 0) << name;
    }
    const auto seen_steadily = squares_of(folder_ / "steady/final.png");
    const auto seen_after_the_cut = squares_of(folder_ / "cut/final.png");
    ASSERT_FALSE(seen_steadily.empty());
    ASSERT_EQ(seen_after_the_cut.size(), seen_steadily.size());
    const double difference = mean_difference(seen_steadily, seen_after_the_cut);
    std::cout << "the two last pictures differ by " << difference << " of 255\n";
    EXPECT_LT(difference, largest_difference_of_pictures);

    const Finished info = run_program(machines_->run(
        Machine::viewer, "packet_replay", {out("session.pcap"), "--info", "--json", out("recorded.json")}));
    EXPECT_EQ(info.status, 0) << info.err;
    EXPECT_EQ(json_of(folder_ / "recorded.json").at("bone_checksum"), served.at("bone_checksum"));
}

}  // namespace
}  // namespace osteomill::testing
