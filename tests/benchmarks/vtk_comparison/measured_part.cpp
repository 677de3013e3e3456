#include "tests/benchmarks/vtk_comparison/measured_part.h"

#include <chrono>
#include <ctime>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "render_client/volume/png_file.h"
#include "render_client/volume/textures/voxel_box.h"
#include "tests/benchmarks/phantom_session.h"
#include "tests/benchmarks/vtk_comparison/measured_picture.h"

namespace osteomill {

namespace {

constexpr float as_the_product_does = 0.0f;
constexpr float reference_step_voxels = 0.1f;
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

std::unique_ptr<MeasuredPicture> make_picture(const std::string& part, const Bone& bone, float step_voxels) {
    if (part == part_names[0]) return our_picture(bone, step_voxels);
    for (const VtkMapper mapper : {VtkMapper::gpu, VtkMapper::cpu})
        for (const VtkVolume volume : {VtkVolume::whole_grid, VtkVolume::cropped}) {
            const std::string name = std::string(mapper == VtkMapper::gpu ? "vtk-gpu" : "vtk-cpu") +
                                     (volume == VtkVolume::cropped ? "-cropped" : "");
            if (part == name) return vtk_picture(bone, volume, mapper, step_voxels);
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

void draw_references(const std::string& part, const std::filesystem::path& folder) {
    const Bone bone = tooth_phantom_bone();
    const auto picture = make_picture(part, bone, reference_step_voxels);
    for (const std::string view : view_names) {
        picture->look_from(camera_of(bone, view));
        picture->draw_all();
        write_png(picture->picture(), folder / (part + "-" + view + "-reference.png"));
    }
}

}  // namespace osteomill
