// What the bone on the graphics card costs: bringing it up to date after a carve, and drawing it.
//
// Scene: the tooth phantom, 512 x 512 x 128 voxels of 0.1 mm, held dense and as a brick atlas. Times are CPU
// time of all threads, which is what a software rasteriser costs.
//
// Updates: a fresh ball is cut out of whole bone, the worst case of a carve of that size; putting it back is
// not timed. A sweep, what a burr does between two frames: the same ball moves on by a tenth of its diameter
// in a slot. Frames: 640 x 480, every pixel, of all of the bone and of the crown close up.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <ctime>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "imaging/phantoms/phantom.h"
#include "render_client/volume/gl/framebuffer.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "studies/render/made_bone.h"

namespace osteomill {
namespace {

const Bone& tooth() {
    static const Bone bone =
        bone_from_hu(make_tooth_phantom(), phantom_threshold_hu, default_stiffness_relation());
    return bone;
}

std::vector<TissueColour> tooth_colours() {
    std::vector<TissueColour> colours;
    for (const Tissue& tissue : phantom_scene("tooth").tissues)
        colours.push_back({tissue.label, tissue.colour_rgb});
    return colours;
}

BoneTextures textures_of(const Bone& bone, BoneLayout layout, Shading shading = Shading::gradient) {
    return {bone, tooth_colours(), {.shading = shading}, {.layout = layout}};
}

const char* name_of(BoneLayout layout) {
    return layout == BoneLayout::dense ? "dense" : "atlas";
}

const char* name_of(Shading shading) {
    return shading == Shading::gradient ? "gradient" : "surface-voxels";
}

double cpu_now_s() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The middle of the whole bone's box.
glm::dvec3 middle_mm(const Grid& grid, const VoxelBox& box) {
    return 0.5 * (centre_of_voxel_mm(grid, box.first) + centre_of_voxel_mm(grid, box.first + box.size - 1));
}

/// Uploads `after` in place of `before` again and again.
void time_update(benchmark::State& state, BoneTextures& textures, const Bone& before, const Bone& after,
                 std::span<const BrickChange> changes) {
    for ([[maybe_unused]] auto _ : state) {
        const double start_s = cpu_now_s();
        textures.update(after, changes);
        glFinish();
        state.SetIterationTime(cpu_now_s() - start_s);
        textures.update(before, changes);
        glFinish();
    }
    state.counters["bricks"] = static_cast<double>(changes.size());
}

/// Argument: burr diameter in tenths of a millimetre.
void update_after_carve(benchmark::State& state, BoneLayout layout, Shading shading) {
    const Bone& whole = tooth();
    Bone carved = whole;
    BoneTextures textures = textures_of(whole, layout, shading);
    const auto changes = carve_sphere(carved, middle_mm(textures.grid(), textures.box()),
                                      0.05 * static_cast<double>(state.range(0)));
    time_update(state, textures, whole, carved, changes);
}

/// Likewise.
void update_in_a_sweep(benchmark::State& state, BoneLayout layout, Shading shading) {
    const double radius_mm = 0.05 * static_cast<double>(state.range(0));
    Bone before = tooth();
    const VoxelBox box = stored_box(before.content());
    const glm::dvec3 middle = middle_mm(before.grid(), box);
    carve_sphere(before, middle, radius_mm);
    Bone after = before;
    const auto changes = carve_sphere(after, middle + glm::dvec3(0.2 * radius_mm, 0.0, 0.0), radius_mm);
    BoneTextures textures = textures_of(before, layout, shading);
    time_update(state, textures, before, after, changes);
}

/// Argument: which view, 0 of all of the bone, 1 of the crown.
void draw_frame(benchmark::State& state, BoneLayout layout, const RaycastSettings& settings) {
    const glm::ivec2 size_px(640, 480);
    const BoneTextures textures = textures_of(tooth(), layout);
    const glm::dvec3 half_mm = 0.5 * textures.grid().spacing_mm * glm::dvec3(textures.box().size);
    Camera camera = camera_on(middle_mm(textures.grid(), textures.box()), glm::length(half_mm));
    if (state.range(0) == 1) {
        camera.target_mm.z += 0.8 * half_mm.z;
        zoom(camera, 0.3);
    }
    RaycastRenderer renderer(settings);
    const gl::Framebuffer framebuffer(size_px);
    const auto draw = [&] {
        framebuffer.bind();
        renderer.draw(textures, camera, size_px);
        glFinish();
    };
    draw();
    for ([[maybe_unused]] auto _ : state) draw();
    state.SetLabel(description(textures.plan()));
}

void register_benchmarks() {
    for (const BoneLayout layout : {BoneLayout::dense, BoneLayout::atlas}) {
        for (const Shading shading : {Shading::gradient, Shading::surface_voxels}) {
            const auto name = [&](const char* what) {
                return fmt::format("{}/{}/{}", what, name_of(layout), name_of(shading));
            };
            const auto add = [&](const std::string& named, const auto& updates) {
                benchmark::RegisterBenchmark(
                    named.c_str(), [=](benchmark::State& state) { updates(state, layout, shading); })
                    ->ArgName("burr_tenths_mm")
                    ->Arg(10)
                    ->Arg(20)
                    ->Arg(30)
                    ->Arg(50)
                    ->UseManualTime()
                    ->Unit(benchmark::kMillisecond);
            };
            add(name("update"), update_after_carve);
            add(name("sweep"), update_in_a_sweep);
        }
        for (const float step : {0.5f, 0.75f, 1.0f, 2.0f})
            benchmark::RegisterBenchmark(
                fmt::format("frame/{}/step {}", name_of(layout), step).c_str(),
                [layout, step](benchmark::State& state) { draw_frame(state, layout, {.step_voxels = step}); })
                ->ArgName("close")
                ->Arg(0)
                ->Arg(1)
                ->Iterations(10)
                ->MeasureProcessCPUTime()
                ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace
}  // namespace osteomill

int main(int argument_count, char** arguments) {
    benchmark::Initialize(&argument_count, arguments);
    if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) return 2;
    benchmark::AddCustomContext("All of it takes", "about two minutes");
    const osteomill::gl::OffscreenContext context;
    fmt::print("{}\n", osteomill::gl::renderer_name());
    osteomill::register_benchmarks();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
