#include "render_client/ui/start/folder_listing.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

TEST(FolderListing, HasFoldersAndFilesByNameWithoutHiddenOnes) {
    const testing::TemporaryFolder folder;
    for (const char* name : {"b", "a", ".git"}) std::filesystem::create_directories(folder / name);
    for (const char* name : {"scan.nrrd", "A.nii", ".hidden"}) std::ofstream(folder / name) << "x";
    std::filesystem::create_symlink("nowhere", folder / "broken");
    const FolderListing listing = list_folder(folder / "a/..");
    EXPECT_EQ(listing.folder / "x", folder / "x") << "a plain path, without ..";
    EXPECT_EQ(listing.folders, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(listing.files, (std::vector<std::string>{"A.nii", "broken", "scan.nrrd"}));
    EXPECT_EQ(listing.problem, "");
}

TEST(FolderListing, HasTheFilesThatAreAskedFor) {
    const testing::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "a");
    for (const char* name : {"b.CSV", "b.ctbl", "b.csv.gz", "csv"}) std::ofstream(folder / name) << "x";
    const FolderListing listing = list_folder(folder.path(), {".csv", ".ctbl"});
    EXPECT_EQ(listing.folders, (std::vector<std::string>{"a"}));
    EXPECT_EQ(listing.files, (std::vector<std::string>{"b.CSV", "b.ctbl"}));
}

TEST(FolderListing, SaysWhyAFolderCannotBeRead) {
    EXPECT_THAT(list_folder("/no/such/folder").problem,
                ::testing::HasSubstr("/no/such/folder: cannot be read"));
    EXPECT_EQ(list_folder("/").folder, "/");
}

}  // namespace
}  // namespace osteomill
