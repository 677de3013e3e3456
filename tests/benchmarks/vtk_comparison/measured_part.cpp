#include "tests/benchmarks/vtk_comparison/measured_part.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "analysis/output/output_files.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/png_file.h"
#include "render_client/volume/textures/voxel_box.h"
#include "studies/render/full_rate/finished_frames.h"
#include "studies/render/phantom_session.h"
#include "tests/benchmarks/vtk_comparison/measured_picture.h"

namespace osteomill {

namespace {

const PictureSetting as_the_product_does{};
const PictureSetting reference{.step_voxels = 0.1f};
const glm::dvec3 crown_mm(0.5, 0.2, 2.0);

Camera camera_of(const Bone& bone, const std::string& view) {
    const Grid& grid = bone.grid();
    const VoxelBox box = stored_box(bone.content());
    const glm::dvec3 half_mm = 0.5 * grid.spacing_mm * glm::dvec3(box.size);
    Camera camera = camera_on(centre_of_voxel_mm(grid, box.first) + half_mm, glm::length(half_mm));
    if (view == view_names[0]) return camera;
    camera.target_mm = crown_mm;
    camera.distance_mm *= 0.3;
    return camera;
}

std::unique_ptr<MeasuredPicture> make_picture(const std::string& part, const Bone& bone,
                                              const PictureSetting& setting) {
    if (part == part_names[0]) return our_picture(bone, setting);
    for (const VtkMapper mapper : {VtkMapper::gpu, VtkMapper::cpu})
        for (const VtkVolume volume : {VtkVolume::whole_grid, VtkVolume::cropped}) {
            const std::string name = std::string(mapper == VtkMapper::gpu ? "vtk-gpu" : "vtk-cpu") +
                                     (volume == VtkVolume::cropped ? "-cropped" : "");
            if (part == name) return vtk_picture(bone, volume, mapper, setting);
        }
    throw std::runtime_error("unknown part '" + part +
                             "'; choose ours, vtk-gpu, vtk-cpu or one of these two with -cropped");
}

double cpu_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
void time(nlohmann::json& times, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu_before_ms = cpu_ms();
    work();
    times["cpu_ms"].push_back(cpu_ms() - cpu_before_ms);
    times["wall_ms"].push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

nlohmann::json measure_part(const std::string& part, int frames, const std::filesystem::path& folder) {
    PhantomSession session;
    session.poll();
    const auto picture = make_picture(part, *session.bone(), as_the_product_does);
    nlohmann::json times;
    for (const std::string view : view_names) {
        picture->look_from(camera_of(*session.bone(), view));
        picture->draw_all();  // compiles shaders, uploads
        for (int frame = 0; frame < frames; ++frame) time(times[view]["full"], [&] { picture->draw_all(); });
        write_png(picture->picture(), folder / (part + "-" + view + ".png"));
    }
    session.mill(true);
    for (const std::string view : view_names) {
        picture->look_from(camera_of(*session.bone(), view));
        picture->draw_all();
        for (int frame = 0; frame < frames; ++frame) {
            session.step();
            const LinkUpdate update = session.poll();
            time(times[view]["after_change"], [&] {
                picture->changed(*session.bone(), update.changes);
                picture->draw_after_change();
            });
        }
    }
    return times;
}

void draw_task(const study::DrawingTask& task, std::optional<int> gpu, const std::filesystem::path& folder) {
    PhantomSession session(task.phantom);
    const auto vtk = vtk_picture(*session.bone(), VtkVolume::cropped, VtkMapper::gpu,
                                 {.size_px = task.size_px, .gpu = gpu});
    Camera camera = task.first_view;
    const auto draw = [&] {
        vtk->look_from(camera);
        vtk->draw_all();
    };
    draw();  // compiles shaders, uploads
    const Picture first = vtk->picture();
    if (std::ranges::adjacent_find(first.rgb, std::not_equal_to()) == first.rgb.end())
        throw std::runtime_error("VTK's GPU mapper draws nothing of it");
    study::FrameStopwatch orbits, carves;
    for (int frame = 0; frame < task.frames; ++frame) {
        orbit(camera, study::orbit_rad_a_frame, 0.0);
        orbits.time(draw);
    }
    write_png(vtk->picture(), folder / ("vtk_" + task.phantom + ".png"));
    camera = task.first_view;
    draw();
    session.mill(true);
    for (int frame = 0; frame < task.frames; ++frame) {
        session.step();
        const LinkUpdate update = session.poll();
        carves.time([&] {
            vtk->changed(*session.bone(), update.changes);
            draw();
        });
    }
    study::write_json({{"gl_renderer", gl::renderer_name()},
                       {"orbit", json_of(orbits.frames())},
                       {"carve", json_of(carves.frames())}},
                      folder / ("vtk_" + task.phantom + ".json"));
}

void draw_references(const std::string& part, const std::filesystem::path& folder) {
    const Bone bone = phantom_bone("tooth");
    const auto picture = make_picture(part, bone, reference);
    for (const std::string view : view_names) {
        picture->look_from(camera_of(bone, view));
        picture->draw_all();
        write_png(picture->picture(), folder / (part + "-" + view + "-reference.png"));
    }
}

}  // namespace osteomill
