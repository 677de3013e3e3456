#include <gtest/gtest.h>

#include "render_client/volume/gl/offscreen_context.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::graphics_devices_test {
namespace {

TEST(GraphicsDevices, AreGpusUnlessTheyAreMesasRasteriser) {
    int first = 0, second = 0, third = 0;
    const std::vector<gl::GraphicsDevice> gpus =
        gl::gpus_among({{&first, "EGL_EXT_device_drm EGL_MESA_device_software"},
                        {&second, "EGL_NV_device_cuda EGL_EXT_device_drm"},
                        {&third, "EGL_EXT_device_drm EGL_EXT_device_drm_render_node"}});
    ASSERT_EQ(gpus.size(), 2U);
    EXPECT_EQ(gpus[0].egl_device, &second);
    EXPECT_EQ(gpus[1].egl_device, &third);
    EXPECT_EQ(gl::gpus_among({{&first, ""}, {&second, "EGL_MESA_device_software_too"}}).size(), 2U);
}

TEST(GraphicsDevices, AreToldFromARasteriserByTheRenderersName) {
    EXPECT_TRUE(gl::is_software_renderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(gl::is_software_renderer("softpipe"));
    EXPECT_FALSE(gl::is_software_renderer("NVIDIA H100 PCIe/PCIe/SSE2"));
    EXPECT_FALSE(gl::is_software_renderer("AMD Radeon RX 6600 (radeonsi, navi23, LLVM 15.0.6)"));
}

TEST(OffscreenContext, RefusesAGpuThatIsNotThere) {
    const std::size_t there = gl::gpus_among(gl::graphics_devices()).size();
    try {
        const gl::OffscreenContext context(static_cast<int>(there));
        ADD_FAILURE() << "there are only " << there;
    } catch (const gl::NoOpenGl& error) {
        EXPECT_EQ(std::string(error.what()).find("GPU " + std::to_string(there) + ": EGL lists "), 0U)
            << error.what();
    }
}

using OffscreenContextTest = OffscreenTest;

TEST_F(OffscreenContextTest, IsOfTheRasteriserWhereThereIsNoGpu) {
    if (!gl::gpus_among(gl::graphics_devices()).empty()) GTEST_SKIP() << "there is a GPU";
    EXPECT_TRUE(gl::is_software_renderer(gl::renderer_name())) << gl::renderer_name();
}

}  // namespace
}  // namespace osteomill::graphics_devices_test
