// haptic_server and render_client on two machines: drill, lose the network, find it again, and end with the
// same bone and the same picture as a viewer that lost nothing.
#include "tests/containers/two_machines.h"

#include <gmock/gmock.h>

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

#include "render_client/volume/picture.h"
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

/// Waits, reading the server's output, until `happened`; false if it is far too late.
template <typename Happened>
bool comes_true(ChildProcess& server, Happened&& happened) {
    const auto deadline = std::chrono::steady_clock::now() + far_too_long;
    while (!happened())
        if (std::chrono::steady_clock::now() > deadline || server.wait(1s)) return false;
    return true;
}

/// Waits until a line about a client has been logged so often.
bool is_said(ChildProcess& server, const std::string& about, const std::string& what, int times) {
    return comes_true(server, [&] {
        int said = 0;
        std::istringstream log(server.err());
        for (std::string line; std::getline(log, line);)
            if (line.find(about) != std::string::npos && line.ends_with(what)) ++said;
        return said >= times;
    });
}

/// The newest of the server's lines that says how much bone is gone; there is one every five seconds.
struct Progress {
    double time_s = 0.0;
    double removed_mm3 = 0.0;
};
Progress progress_of(const ChildProcess& server) {
    Progress newest;
    std::istringstream log(server.err());
    for (std::string line; std::getline(log, line);) {
        const std::size_t at = line.find("removed ");
        if (at == std::string::npos || line.find("mm^3", at) == std::string::npos) continue;
        newest = {.time_s = std::stod(line), .removed_mm3 = std::stod(line.substr(at + 8))};
    }
    return newest;
}

/// Drills a hole by pecking and lets go of the pedal above each peck: a loop that gets no core stops for
/// safety, and mills on once it is clear of the bone and the pedal is pressed anew. Then takes the burr out
/// of the picture. The burr rests until both viewers are there, which open on the tool, or their pictures
/// would differ by its place. Returns the time when it is out.
double write_drilling(const std::filesystem::path& file) {
    constexpr int pecks = 15;
    constexpr double first_peck_s = 12.0;
    constexpr double clear_mm = 4.2;
    constexpr double out_s = first_peck_s + pecks + 1.5;
    std::ofstream out(file);
    out << "t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal\n0,0.5,0.2,5.5,0,0,1,0\n"
        << first_peck_s - 0.5 << ",0.5,0.2,5.5,0,0,1,0\n";
    for (int peck = 0; peck < pecks; ++peck)
        out << first_peck_s + peck << ",0.5,0.2," << clear_mm << ",0,0,1,0\n"
            << first_peck_s + peck + 0.1 << ",0.5,0.2," << clear_mm << ",0,0,1,1\n"
            << first_peck_s + peck + 0.6 << ",0.5,0.2," << 3.2 - 0.06 * peck << ",0,0,1,1\n";
    out << first_peck_s + pecks << ",0.5,0.2," << clear_mm << ",0,0,1,0\n"
        << out_s << ",0.5,0.2,60,0,0,1,0\n120,0.5,0.2,60,0,0,1,0\n";
    return out_s;
}

double mean_difference(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    return sum / static_cast<double>(a.rgb.size());
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
        return machines_->run(
            where, "render_client",
            {"--connect", machines_->server_for(where) + ":7010", "--offscreen", "--no-panels",
             "--window-size", "640x480", "--frames", "100000", "--screenshots", out(name),
             "--screenshot-every", "100000", "--json", out(name + ".json")});
    }

    TemporaryFolder folder_;
    std::unique_ptr<TwoMachines> machines_;
};

TEST_F(TwoMachinesTest, EndWithTheSameBoneAndPictureThoughTheCableWasPulled) {
    constexpr auto longer_than_a_client_bears_silence = 6s;
    constexpr double is_drilling_mm3 = 0.02;
    // A few pixels may differ by a shade of 255. One brick that differs changes hundreds.
    constexpr double largest_difference_of_pictures = 0.001;
    const double out_s = write_drilling(folder_ / "drilling.csv");
    ChildProcess server(
        machines_->run(Machine::server, "haptic_server",
                       {"--listen", "0.0.0.0:7010", "--insecure-network", "--trajectory", out("drilling.csv"),
                        "--record", out("session.pcap"), "--json", out("server.json")}));
    ASSERT_TRUE(server.address()) << server.err();
    ChildProcess steady(viewer(Machine::beside_server, "steady"));
    ChildProcess cut(viewer(Machine::viewer, "cut"));
    const std::string far = "client " + machines_->viewer_address() + ":";
    ASSERT_TRUE(is_said(server, "client 127.0.0.1:", "joined", 1)) << server.err() << steady.err();
    ASSERT_TRUE(is_said(server, far, "joined", 1)) << server.err() << cut.err();
    ASSERT_TRUE(comes_true(server, [&] { return progress_of(server).removed_mm3 > is_drilling_mm3; }))
        << server.err();
    const double removed_before_mm3 = progress_of(server).removed_mm3;
    machines_->pull_cable();
    std::this_thread::sleep_for(longer_than_a_client_bears_silence);
    machines_->plug_cable();
    ASSERT_TRUE(is_said(server, far, "joined", 2)) << server.err() << cut.err();
    ASSERT_TRUE(comes_true(server, [&] { return progress_of(server).time_s > out_s; })) << server.err();
    server.send_signal(SIGINT);
    ASSERT_EQ(server.wait(), 0) << server.err();
    ASSERT_EQ(steady.wait(), 0) << steady.err();
    ASSERT_EQ(cut.wait(), 0) << cut.err();

    const auto served = json_of(folder_ / "server.json");
    EXPECT_GT(served.at("removed_mm3").at("total"), removed_before_mm3 + is_drilling_mm3)
        << "it drilled on without the cable\n"
        << server.err();
    for (const char* name : {"steady", "cut"}) {
        const auto seen = json_of(folder_ / (std::string(name) + ".json"));
        EXPECT_EQ(seen.at("bone_checksum"), served.at("bone_checksum")) << name;
        EXPECT_EQ(seen.at("checksum_mismatches"), 0) << name;
        EXPECT_GT(seen.at("frames"), 0) << name;
    }
    const Picture seen_steadily = read_png(folder_ / "steady/final.png");
    const Picture seen_after_the_cut = read_png(folder_ / "cut/final.png");
    ASSERT_FALSE(seen_steadily.rgb.empty());
    ASSERT_EQ(seen_after_the_cut.size_px, seen_steadily.size_px);
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
