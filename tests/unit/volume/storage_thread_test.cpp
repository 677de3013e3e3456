#include "render_client/volume/gl/storage_thread.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

#include "render_client/volume/gl/gl_error.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill::storage_thread_test {
namespace {

class StorageThreadTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            context_.emplace();
        } catch (const gl::NoOpenGl& error) {
            GTEST_SKIP() << "needs OpenGL without a display: " << error.what();
        }
        auto second = context_->second();
        if (!second) GTEST_SKIP() << "needs two contexts that share textures";
        thread_.emplace(std::move(second));
    }

    std::optional<gl::OffscreenContext> context_;
    std::optional<gl::StorageThread> thread_;
};

TEST_F(StorageThreadTest, MakesTexturesForTheContextThatItSharesThemWith) {
    gl::Texture3D texture = thread_->make(gl::VoxelFormat::interpolated_byte, {4, 2, 2}).get();
    const std::vector<std::uint8_t> written{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    texture.upload({0, 0, 0}, {4, 2, 2}, written);
    std::vector<std::uint8_t> read(16);
    texture.read_back(read);
    EXPECT_EQ(read, written);
    EXPECT_NO_THROW(gl::require_no_gl_error("using it"));
}

TEST_F(StorageThreadTest, SaysThatThereIsNoMemoryToWhoeverAskedAndGoesOn) {
    auto too_large =
        thread_->make(gl::VoxelFormat::interpolated_byte, glm::ivec3(2 * gl::max_texture3d_edge(), 1, 1));
    auto fits = thread_->make(gl::VoxelFormat::interpolated_byte, {4, 4, 4});
    EXPECT_THROW(too_large.get(), gl::NoTextureMemory);
    EXPECT_EQ(fits.get().size(), glm::ivec3(4));
}

TEST_F(StorageThreadTest, DiscardsWhatItIsGivenAndWhatNobodyFetchedBeforeItEnds) {
    auto texture = std::make_shared<gl::Texture3D>(gl::VoxelFormat::interpolated_byte, glm::ivec3(4));
    const std::weak_ptr<gl::Texture3D> watched = texture;
    (void)thread_->make(gl::VoxelFormat::interpolated_byte, {4, 4, 4});
    thread_->discard(std::move(texture));
    thread_.reset();
    EXPECT_TRUE(watched.expired());
    EXPECT_NO_THROW(gl::require_no_gl_error("discarding"));
}

}  // namespace
}  // namespace osteomill::storage_thread_test
