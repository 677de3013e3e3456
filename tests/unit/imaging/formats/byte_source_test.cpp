#include "imaging/formats/byte_source.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

#include "imaging/bone_file/gzip_writer.h"
#include "imaging/imaging_error.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;

/// Several pieces, half of it noise.
std::vector<std::byte> many_bytes() {
    std::vector<std::byte> bytes(20'000'001);
    std::mt19937 random(3);
    for (std::size_t i = 0; i < bytes.size() / 2; i += 7) bytes[i] = static_cast<std::byte>(random());
    return bytes;
}

std::string zipped(std::span<const std::byte> bytes) {
    std::string text;
    GzipWriter writer([&](std::span<const std::byte> some) {
        text.append(reinterpret_cast<const char*>(some.data()), some.size());
    });
    writer.add(bytes.first(bytes.size() / 3));
    writer.add(bytes.subspan(bytes.size() / 3));
    writer.finish();
    return text;
}

class ByteSourceOfFile : public ::testing::Test {
  protected:
    ByteSource source(const std::string& text, Encoding encoding = Encoding::gzip) {
        std::ofstream(path_, std::ios::binary) << "head" << text;
        return {std::make_shared<const InputFile>(path_), 4, encoding};
    }
    std::string refusal(ByteSource source, std::size_t bytes) {
        return testing::message_of<ImagingError>([&] {
            std::vector<std::byte> read(bytes);
            source.read(read);
            source.finish();
        });
    }
    testing::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "x";
    std::vector<std::byte> small_ = std::vector<std::byte>(1000, std::byte{7});
};

TEST_F(ByteSourceOfFile, MayBeFilledUpWithZeros) {
    EXPECT_EQ(refusal(source(zipped(small_) + std::string(700'000, '\0')), 1000), "");
    EXPECT_EQ(refusal(source(zipped(small_) + std::string(3, '\0') + zipped(small_)), 2000), "");
    EXPECT_THAT(refusal(source(zipped(small_) + std::string(3, '\0') + "x"), 1000),
                HasSubstr("1 bytes of something else"));
}

TEST_F(ByteSourceOfFile, GivesBackWhatWasCompressedInPieces) {
    const std::vector<std::byte> bytes = many_bytes();
    ByteSource read_again = source(zipped(bytes));
    std::vector<std::byte> read(bytes.size() - 1'000'000);
    read_again.skip(1'000'000);
    read_again.read(read);
    read_again.finish();
    EXPECT_TRUE(std::equal(read.begin(), read.end(), bytes.begin() + 1'000'000));
}

TEST_F(ByteSourceOfFile, IsWhatGzipItselfReads) {
    const std::vector<std::byte> bytes = many_bytes();
    std::ofstream(folder_ / "x.gz", std::ios::binary) << zipped(bytes);
    ASSERT_EQ(std::system(("gzip -dk " + (folder_ / "x.gz").string()).c_str()), 0);
    std::ifstream file(folder_ / "x", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    ASSERT_EQ(text.size(), bytes.size());
    EXPECT_EQ(std::memcmp(text.data(), bytes.data(), bytes.size()), 0);
}

TEST_F(ByteSourceOfFile, ReadsSeveralMembersAndPlainBytes) {
    EXPECT_EQ(refusal(source(zipped(small_) + zipped(small_)), 2000), "");
    EXPECT_EQ(refusal(source(std::string(1000, 'x'), Encoding::raw), 1000), "");
    EXPECT_EQ(refusal(source(zipped({})), 0), "");
}

TEST_F(ByteSourceOfFile, RefusesWhatIsCutOffOrDamagedOrTooLong) {
    const std::string text = zipped(small_);
    EXPECT_THAT(refusal(source(text), 1001), HasSubstr("cut off"));
    EXPECT_THAT(refusal(source(text), 999), HasSubstr("more than the 999 bytes"));
    EXPECT_THAT(refusal(source(text.substr(0, text.size() - 1)), 1000), HasSubstr("cut off"));
    EXPECT_THAT(refusal(source(text.substr(0, text.size() - 9)), 1000), HasSubstr("cut off"));
    EXPECT_THAT(refusal(source(std::string(999, 'x'), Encoding::raw), 1000), HasSubstr("cut off"));
    std::string flipped = text;
    flipped[flipped.size() - 8] = static_cast<char>(flipped[flipped.size() - 8] ^ 4);
    EXPECT_THAT(refusal(source(flipped), 1000), HasSubstr("damaged (gzip: incorrect data check)"));
}

TEST(CanHold, KnowsThatDeflateHasALimit) {
    EXPECT_TRUE(can_hold(1000, 1000, Encoding::raw));
    EXPECT_FALSE(can_hold(1000, 1001, Encoding::raw));
    EXPECT_TRUE(can_hold(1000, 1'000'000, Encoding::gzip));
    EXPECT_FALSE(can_hold(1000, 2'000'000, Encoding::gzip));
}

}  // namespace
}  // namespace osteomill
