#include "imaging/resampling/scratch_values.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "imaging/imaging_error.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

constexpr std::uint64_t count = 10'000'000;

TEST(ScratchValues, KeepWhatWasWrittenWhenTheyAreLetGo) {
    const testing::TemporaryFolder folder;
    for (const std::uint64_t most_bytes : {4 * count, 4 * count - 1}) {
        const ScratchValues scratch(count, most_bytes, folder.path());
        ASSERT_EQ(scratch.values().size(), count);
        EXPECT_EQ(scratch.values()[count - 1], 0.0F);
        for (std::size_t i = 0; i < count; ++i) scratch.values()[i] = static_cast<float>(i);
        scratch.let_go();
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(scratch.values()[i], static_cast<float>(i));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the file has no name";
}

TEST(ScratchValues, SayThatTheDiskIsFull) {
    const testing::TemporaryFolder folder;
    const testing::FileSizeLimit full_disk(1'000'000);
    try {
        const ScratchValues scratch(count, 0, folder.path());
        ADD_FAILURE() << "accepted";
    } catch (const ImagingError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr(folder.path().string() + ": has no room"));
    }
}

}  // namespace
}  // namespace osteomill
