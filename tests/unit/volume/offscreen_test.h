// A test with an OpenGL context of its own; skipped with a plain message if there is none.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "render_client/volume/gl/gl_error.h"
#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill {

class OffscreenTest : public ::testing::Test {
  protected:
    void SetUp() override {
        try {
            context_.emplace();
        } catch (const gl::NoOpenGl& error) {
            GTEST_SKIP() << "needs OpenGL without a display: " << error.what();
        }
    }
    void TearDown() override {
        if (!context_) return;
        EXPECT_NO_THROW(gl::require_no_gl_error("running this test"));
    }

  private:
    std::optional<gl::OffscreenContext> context_;
};

}  // namespace osteomill
