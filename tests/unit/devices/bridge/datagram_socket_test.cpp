#include "devices/bridge/datagram_socket.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// A socket there, open; as another program makes it, or one of ours.
int make_socket(const std::filesystem::path& path, int type, mode_t mode = 0755) {
    const int made = socket(AF_UNIX, type, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(chmod(path.c_str(), mode), 0);
    return made;
}

/// A socket file that a killed server left.
void leave_socket(const std::filesystem::path& path) {
    close(make_socket(path, SOCK_DGRAM, 0700));
}

TEST(DatagramSocket, TakesOverWhatAKilledServerLeftAndNothingElse) {
    const testing::TemporaryFolder folder;
    const BridgeAddress where = BridgePath{folder / "arm"};
    leave_socket(folder / "arm");
    {
        const DatagramSocket first(where);
        try {
            const DatagramSocket second(where);
            FAIL();
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("another program listens there"));
        }
        struct stat found {};
        ASSERT_EQ(lstat((folder / "arm").c_str(), &found), 0);
        EXPECT_EQ(found.st_mode & 0777, 0700) << "others of this machine do not write there";
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "arm"));
    std::ofstream(folder / "arm") << "kept";
    EXPECT_THROW(DatagramSocket{where}, std::runtime_error);
    EXPECT_TRUE(std::filesystem::exists(folder / "arm"));
    EXPECT_THROW(DatagramSocket{BridgePath{folder / "nowhere" / "arm"}}, std::runtime_error);
}

TEST(DatagramSocket, RemovesNothingOfOthers) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path path = folder / "arm";
    const auto refusal = [&]() -> std::string {
        return testing::message_of<std::runtime_error>(
            [&] { const DatagramSocket taken{BridgeAddress(BridgePath{path})}; });
    };
    for (const int type : {SOCK_STREAM, SOCK_DGRAM, SOCK_SEQPACKET}) {
        for (const bool listens : {false, true}) {
            const int others = make_socket(path, type);
            if (listens && type != SOCK_DGRAM) {
                ASSERT_EQ(listen(others, 1), 0);
            }
            EXPECT_THAT(refusal(), HasSubstr("another program listens there"));
            close(others);
            EXPECT_THAT(refusal(), HasSubstr("is a socket that another program has left; remove it"));
            EXPECT_TRUE(std::filesystem::exists(path));
            std::filesystem::remove(path);
        }
    }
    std::filesystem::create_symlink("nowhere", path);
    EXPECT_THAT(refusal(), HasSubstr("is a file, and no socket"));
    EXPECT_TRUE(std::filesystem::is_symlink(path));
    std::filesystem::remove(path);
    // The file that stands there at the end is another's.
    for (const bool is_socket : {false, true}) {
        {
            const DatagramSocket own{BridgeAddress(BridgePath{path})};
            std::filesystem::rename(path, folder / "moved");
            if (is_socket)
                leave_socket(path);
            else
                std::ofstream(path) << "kept";
        }
        EXPECT_TRUE(std::filesystem::exists(path));
        std::filesystem::remove(path);
    }
}

TEST(DatagramSocket, CarriesDatagramsBothWays) {
    DatagramSocket one(parse_bridge_address("udp:127.0.0.1:0"));
    DatagramSocket other(parse_bridge_address("udp:127.0.0.1:0"));
    EXPECT_NE(std::get<ListenAddress>(one.address()).port, 0);
    std::array<std::uint8_t, 8> buffer{};
    PeerAddress from;
    EXPECT_FALSE(one.receive(buffer, from, 0));
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(std::get<ListenAddress>(one.address()).port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&to);
    const std::array<std::uint8_t, 3> said{1, 2, 3};
    other.send(said, PeerAddress(bytes, bytes + sizeof to));
    ASSERT_EQ(one.receive(buffer, from, 1000), 3u);
    EXPECT_EQ(buffer[2], 3);
    one.send(said, from);
    EXPECT_EQ(other.receive(buffer, from, 1000), 3u);
    one.send(said, {});  // to nobody: nothing happens
}

}  // namespace
}  // namespace osteomill
