#include "common/files/output_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

class OutputPlaceTest : public ::testing::Test {
  protected:
    OutputPlaceTest() {
        fs::create_directory(lab_);
        ::setenv("XDG_DATA_HOME", (folder_ / "data").c_str(), 1);
    }
    void expect_taken(const fs::path& file) const {
        EXPECT_THAT([&] { OutputPlace{file}; },
                    ThrowsMessage<std::runtime_error>(HasSubstr("another session will write it")))
            << file;
    }

    TemporaryFolder folder_;
    fs::path lab_ = folder_ / "lab";
    fs::path file_ = lab_ / "carved.nrrd";
};

TEST_F(OutputPlaceTest, IsWhereItWasRequested) {
    OutputPlace place(file_);
    EXPECT_EQ(place.now(), file_);
    EXPECT_THAT(place.news(), IsEmpty());
    EXPECT_EQ(OutputPlace("/dev/null").now(), "/dev/null");
    EXPECT_THROW(OutputPlace(folder_ / "nowhere/carved.nrrd"), std::runtime_error);
}

TEST_F(OutputPlaceTest, IsOneSessionsAtATime) {
    fs::create_symlink("lab", folder_ / "link");
    std::ofstream(file_) << "old";
    fs::create_symlink("lab/carved.nrrd", folder_ / "second.nrrd");
    {
        const OutputPlace first(file_);
        expect_taken(file_);
        expect_taken(folder_ / "link/carved.nrrd");
        expect_taken(folder_ / "second.nrrd");
        EXPECT_NO_THROW(OutputPlace(lab_ / "other.nrrd"));
    }
    EXPECT_NO_THROW(OutputPlace{file_});
    fs::remove(file_);
    EXPECT_FALSE(fs::exists(lab_ / ".carved.nrrd.lock")) << "nothing is left";
}

TEST_F(OutputPlaceTest, IsReservedWhileItsProgramRuns) {
    EXPECT_FALSE(is_reserved(file_));
    {
        const OutputPlace place(file_);
        EXPECT_TRUE(is_reserved(file_));
        expect_taken(file_);
    }
    EXPECT_FALSE(is_reserved(file_));
    std::ofstream(lab_ / ".carved.nrrd.lock") << "";
    EXPECT_FALSE(is_reserved(file_)) << "a killed program left it";
}

TEST_F(OutputPlaceTest, IsFreeAfterAProgramWasKilled) {
    const pid_t child = ::fork();
    if (child == 0) {
        new OutputPlace(file_);
        ::_exit(0);  // as by SIGKILL: nothing is undone
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(fs::exists(lab_ / ".carved.nrrd.lock"));
    EXPECT_NO_THROW(OutputPlace{file_});
}

TEST_F(OutputPlaceTest, FollowsAFolderThatIsRenamed) {
    OutputPlace place(file_);
    fs::rename(lab_, folder_ / "renamed");
    EXPECT_THAT(place.news(), HasSubstr((folder_ / "renamed/carved.nrrd").string()));
    EXPECT_THAT(place.news(), IsEmpty()) << "said once";
    EXPECT_EQ(place.now(), folder_ / "renamed/carved.nrrd");
    fs::rename(folder_ / "renamed", lab_);
    EXPECT_EQ(place.now(), file_);
    EXPECT_THAT(place.news(), IsEmpty());
}

TEST_F(OutputPlaceTest, IsBesideAFolderThatIsRemoved) {
    OutputPlace place(file_);
    fs::remove_all(lab_);
    EXPECT_THAT(place.news(), HasSubstr((folder_ / "lab.rescued/carved.nrrd").string()));
    EXPECT_EQ(place.now(), folder_ / "lab.rescued/carved.nrrd");
    EXPECT_TRUE(fs::is_directory(folder_ / "lab.rescued"));
    std::ofstream(place.now()) << "saved";
    EXPECT_EQ(place.now(), folder_ / "lab.rescued/carved.nrrd") << "the second save takes the same place";
    fs::create_directory(lab_);
    EXPECT_EQ(place.now(), file_) << "the folder is back";
    OutputPlace another(file_);
    fs::remove_all(lab_);
    EXPECT_EQ(another.now(), folder_ / "lab.rescued/carved-2.nrrd") << "what was rescued before stays";
}

TEST_F(OutputPlaceTest, IsInTheFolderOfDataWhereThereIsNoneBesideIt) {
    OutputPlace place(file_);
    fs::remove_all(lab_);
    std::ofstream(folder_ / "lab.rescued") << "a file in the way";
    EXPECT_EQ(place.now(), folder_ / "data/osteomill/rescued/carved.nrrd");
}

}  // namespace
}  // namespace osteomill
