#include "imaging/formats/voxel_data.h"

#include <gmock/gmock.h>

#include <functional>
#include <stdexcept>

#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/messages.h"
#include "tests/support/raw_images.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::voxel_data_test {
namespace {

using testing::deflated;
using ::testing::HasSubstr;
using testing::write_bytes;

std::string refusal(const std::function<void()>& act) {
    return testing::message_of<std::exception>([&] { act(); });
}

TEST(NumberedName, FillsOneNumberInAndNothingElse) {
    EXPECT_EQ(numbered_name("slice%03d.raw", 7), "slice007.raw");
    EXPECT_EQ(numbered_name("%d", 12), "12");
    for (const char* pattern : {"s%s", "s%n", "s%d%d", "s%%d", "s%", "s%0", "s%3d", "s%-3d", "s%*d", "s%ld",
                                "s%0999999999d", "plain"})
        EXPECT_THAT(refusal([&] { numbered_name(pattern, 1); }), HasSubstr("no other %")) << pattern;
    EXPECT_THAT(refusal([] { numbered_name(std::string(5000, 'a') + "%d", 1); }), HasSubstr("letters"));
}

class VoxelFiles : public ::testing::Test {
  protected:
    /// The message on 100 bytes of this encoding, from the file's 3rd byte on: about their size, or from
    /// reading them.
    std::string reading(const std::string& bytes, Encoding encoding) {
        write_bytes(folder_ / "x.raw", "ab" + bytes);
        data_ = {.encoding = encoding, .parts = {{.file = folder_ / "x.raw", .begin = 2, .bytes = 100}}};
        read_.clear();
        return refusal([&] {
            more_ = require_room(data_);
            read_voxel_data(data_, [&](std::span<const std::byte> piece) {
                for (const std::byte byte : piece) read_ += static_cast<char>(byte);
            });
        });
    }
    testing::TemporaryFolder folder_;
    VoxelData data_;
    std::uint64_t more_ = 0;
    std::string read_;
    const std::string hundred_ = std::string(50, 'x') + std::string(50, 'y');
};

TEST_F(VoxelFiles, AreReadWhenTheyHaveTheirBytesAndTheirChecksum) {
    for (const auto& [bytes, encoding] :
         {std::pair{hundred_, Encoding::raw}, std::pair{deflated(hundred_), Encoding::gzip},
          std::pair{deflated(hundred_.substr(0, 7)) + deflated(hundred_.substr(7)), Encoding::gzip},
          std::pair{deflated(hundred_), Encoding::zlib_or_gzip},
          std::pair{deflated(hundred_, 15), Encoding::zlib_or_gzip}}) {
        EXPECT_EQ(reading(bytes, encoding), "");
        EXPECT_EQ(read_, hundred_);
    }
    EXPECT_EQ(reading(hundred_ + "more", Encoding::raw), "");
    EXPECT_EQ(more_, 4u);
}

TEST_F(VoxelFiles, SkipDecodedBytesBeforeThem) {
    write_bytes(folder_ / "x.gz", deflated("skipped" + hundred_));
    const VoxelData data{.encoding = Encoding::gzip,
                         .parts = {{.file = folder_ / "x.gz", .bytes = 100, .skipped_bytes = 7}}};
    read_voxel_data(data, [&](std::span<const std::byte> piece) {
        for (const std::byte byte : piece) read_ += static_cast<char>(byte);
    });
    EXPECT_EQ(read_, hundred_);
}

TEST_F(VoxelFiles, AreRefusedWhenCutOffOrDamagedOrFollowedByMore) {
    EXPECT_THAT(reading(hundred_.substr(1), Encoding::raw), HasSubstr("99 of 100 bytes"));
    for (const int window : {31, 15}) {
        const auto encoding = window == 31 ? Encoding::gzip : Encoding::zlib_or_gzip;
        const std::string good = deflated(hundred_, window);
        for (std::size_t length = 0; length < good.size(); ++length)
            EXPECT_THAT(reading(good.substr(0, length), encoding), HasSubstr("x.raw")) << length;
        std::string flipped = good;
        flipped[good.size() - (window == 31 ? 7 : 1)] ^= 1;
        EXPECT_THAT(reading(flipped, encoding), HasSubstr("damaged"));
        EXPECT_THAT(reading(good + "1", encoding), HasSubstr("has 1 bytes of something else"));
        EXPECT_THAT(reading(deflated(hundred_ + "z", window), encoding),
                    HasSubstr("more than the 100 bytes"));
        EXPECT_THAT(reading(deflated(hundred_.substr(1), window), encoding), HasSubstr("end after 99 bytes"));
    }
    EXPECT_THAT(reading(deflated(hundred_, 15), Encoding::gzip), HasSubstr("damaged"));
}

TEST_F(VoxelFiles, StopReadingABombAtWhatTheHeaderSays) {
    EXPECT_THAT(reading(deflated(std::string(50'000'000, '\0')), Encoding::gzip),
                HasSubstr("more than the 100 bytes"));
    data_.parts[0].bytes = std::uint64_t{1} << 36U;
    EXPECT_THAT(refusal([&] { require_room(data_); }), HasSubstr(testing::impossible_compression));
}

TEST_F(VoxelFiles, OfSeveralSlicesHaveTheirSizesExactly) {
    write_bytes(folder_ / "a", hundred_);
    write_bytes(folder_ / "b", hundred_ + "z");
    const VoxelData data{
        .parts = {{.file = folder_ / "a", .bytes = 100}, {.file = folder_ / "b", .bytes = 100}}};
    EXPECT_THAT(refusal([&] { require_room(data); }), HasSubstr("b: holds 101 bytes, where 100"));
}

TEST_F(VoxelFiles, LieBesideTheirHeader) {
    std::filesystem::create_directories(folder_ / "in/below");
    write_bytes(folder_ / "in/x.raw", "1");
    write_bytes(folder_ / "in/below/y.raw", "1");
    write_bytes(folder_ / "out.raw", "1");
    std::filesystem::create_symlink("../out.raw", folder_ / "in/link.raw");
    std::filesystem::create_symlink("x.raw", folder_ / "in/good.raw");
    const std::filesystem::path header = folder_ / "in/x.mhd";
    EXPECT_EQ(data_file_beside(header, "x.raw"), folder_ / "in/x.raw");
    EXPECT_EQ(data_file_beside(header, "below/y.raw"), folder_ / "in/below/y.raw");
    EXPECT_EQ(data_file_beside(header, "good.raw"), folder_ / "in/good.raw");
    for (const std::string name : {"../out.raw", "/etc/passwd", "link.raw", "below/../../out.raw"})
        EXPECT_THAT(refusal([&] { data_file_beside(header, name); }), HasSubstr("leads out")) << name;
    EXPECT_THAT(refusal([&] { data_file_beside(header, "none"); }), HasSubstr("is not there"));
    EXPECT_THAT(refusal([&] { data_file_beside(header, "below"); }), HasSubstr("is not a file"));
    for (const std::string& name : {std::string(), std::string("a\0b", 3), std::string("below/")})
        EXPECT_THAT(refusal([&] { data_file_beside(header, name); }), HasSubstr("is no name of a file"));
}

}  // namespace
}  // namespace osteomill::voxel_data_test
