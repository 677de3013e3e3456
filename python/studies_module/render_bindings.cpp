// Pictures, offscreen: views of trial bones beside a reference image, a cut wall, and frames a second in a
// window.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "python/module/arrays.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "studies/render/carved_sphere.h"
#include "studies/render/full_rate/carve_upload.h"
#include "studies/render/full_rate/window_frames.h"
#include "studies/render/picture_trial.h"
#include "studies/render/trial_bone.h"

namespace osteomill::python {

namespace py = pybind11;

namespace {

using study::PictureTrial;
using study::TrialBone;

ShadingSettings look_of(const std::string& shading, const std::string& transfer) {
    ShadingSettings look;
    if (shading == "surface-voxels")
        look.shading = Shading::surface_voxels;
    else if (shading != "gradient")
        throw std::invalid_argument("shading: takes gradient or surface-voxels, not " + shading);
    if (transfer.empty()) return look;
    const auto& presets = transfer_presets();
    const auto preset = std::ranges::find(presets, transfer, &TransferFunction::name);
    if (preset == presets.end()) throw std::invalid_argument("transfer: no preset is called " + transfer);
    look.transfer = *preset;
    return look;
}

glm::ivec2 frame_size_of(const std::pair<int, int>& size_px) {
    if (std::min(size_px.first, size_px.second) < 1 || std::max(size_px.first, size_px.second) > 16384)
        throw std::invalid_argument("size_px: takes 1 to 16384 pixels either way");
    return {size_px.first, size_px.second};
}

std::unique_ptr<PictureTrial> picture_of(const TrialBone& trial, const std::string& view,
                                         const std::string& shading, const std::string& transfer,
                                         const std::pair<int, int>& size_px, std::optional<int> gpu) {
    if (view != "overview" && view != "close-up")
        throw std::invalid_argument("view: takes overview or close-up, not " + view);
    const ShadingSettings look = look_of(shading, transfer);
    const glm::ivec2 size = frame_size_of(size_px);
    const py::gil_scoped_release released;
    return std::make_unique<PictureTrial>(trial.bone, trial.tissues, look,
                                          view == "overview" ? trial.overview : trial.close_up, size, true,
                                          gpu);
}

py::dict dict_of(const study::FrameMilliseconds& frames) {
    using py::literals::operator""_a;
    return py::dict("wall_ms"_a = frames.wall, "gpu_ms"_a = frames.gpu, "cpu_ms"_a = frames.cpu);
}

py::dict upload_carves(const std::string& phantom, int times, std::optional<int> gpu) {
    study::CarveUpload found;
    {
        const py::gil_scoped_release released;
        const gl::OffscreenContext context(gpu);
        found = study::upload_carves(phantom, times);
    }
    py::dict textures;
    for (const TextureSize& each : found.textures) textures[py::str(each.name)] = each.bytes;
    using py::literals::operator""_a;
    return py::dict(
        "description"_a = description(found.plan), "texture_bytes"_a = found.plan.bytes,
        "textures"_a = textures, "layout"_a = found.plan.layout == BoneLayout::dense ? "dense" : "atlas",
        "times_coarser"_a = found.plan.coarsening, "has_smoothed_fractions"_a = found.plan.smoothed,
        "upload_of_frame"_a = dict_of(found.by_frame), "upload_of_5_mm_ball"_a = dict_of(found.by_ball),
        "bricks_of_5_mm_ball"_a = found.bricks_of_ball);
}

py::dict draw_window(const std::string& phantom, const std::pair<int, int>& size_px, int frames,
                     const std::filesystem::path& picture, std::optional<int> gpu) {
    study::WindowFrames drawn;
    {
        const py::gil_scoped_release released;
        const gl::OffscreenContext context(gpu);
        drawn = study::draw_window(phantom, frame_size_of(size_px), frames, picture);
    }
    using py::literals::operator""_a;
    return py::dict("orbit"_a = dict_of(drawn.orbit), "carve"_a = dict_of(drawn.carve),
                    "orbit_side_by_side"_a = dict_of(drawn.orbit_side_by_side),
                    "orbit_both_whole"_a = dict_of(drawn.orbit_both_whole));
}

}  // namespace

void bind_rendering(py::module_& module) {
    module.def(
        "what_draws",
        [](std::optional<int> gpu) {
            const gl::OffscreenContext context(gpu);
            const std::string renderer = gl::renderer_name();
            return std::pair(renderer, gl::is_software_renderer(renderer));
        },
        py::arg("gpu") = py::none(),
        "The name of OpenGL's renderer without a display, on that GPU, and whether it is a software "
        "rasteriser.");
    py::class_<TrialBone>(module, "TrialBone", "A bone that pictures are measured on, and its views.")
        .def(py::init([](const std::string& name, const std::filesystem::path& scans,
                         const std::filesystem::path& folder) {
                 const py::gil_scoped_release released;
                 return with_printable_error([&] { return study::trial_bone(name, scans, folder); });
             }),
             py::arg("name"), py::arg("scans"), py::arg("folder"))
        .def("picture", &picture_of, py::kw_only(), py::arg("view"), py::arg("shading"), py::arg("transfer"),
             py::arg("size_px"), py::arg("gpu") = py::none(),
             "A view of it: overview or close-up; transfer: the name of a preset, or empty.");
    module.def(
        "cut_wall_psnr_db",
        [](double px_per_voxel, std::optional<int> gpu) {
            const gl::OffscreenContext context(gpu);
            return study::carved_sphere_psnr_db(px_per_voxel);
        },
        py::arg("px_per_voxel"), py::arg("gpu") = py::none(), py::call_guard<py::gil_scoped_release>(),
        "PSNR of the picture of a wall cut by a sphere, against the analytic one.");
    module.def("cut_wall_normals_p95_deg", &study::carved_sphere_normals_p95_deg,
               py::call_guard<py::gil_scoped_release>(),
               "95th percentile of the angle between the normals of such a wall and the sphere's.");
    module.def("upload_carves", &upload_carves, py::arg("phantom"), py::arg("times"),
               py::arg("gpu") = py::none(),
               "Textures of a phantom, and what it costs to take a carve over into them.");
    module.def("draw_window", &draw_window, py::arg("phantom"), py::arg("size_px"), py::arg("frames"),
               py::arg("picture"), py::arg("gpu") = py::none(),
               "Frames of a session as the window draws them, each finished before the next; leaves a PNG.");
}

// Pictures, offscreen: the time of a frame in any way of drawing, and its error against the reference image.

namespace {

using study::DrawnWay;
using study::PictureTrial;

constexpr double close_up_radius_mm = 7.0;

template <typename Value>
Value one_of(const std::string& name, const char* what,
             const std::vector<std::pair<const char*, Value>>& all) {
    std::string known;
    for (const auto& [one, value] : all) {
        if (name == one) return value;
        known += (known.empty() ? "" : ", ") + std::string(one);
    }
    throw std::invalid_argument(fmt::format("{}: '{}' is not one of {}", what, name, known));
}

ShadingSettings look_named(const std::string& shading) {
    return {.shading = one_of<Shading>(
                shading, "shading",
                {{"gradient", Shading::gradient}, {"surface-voxels", Shading::surface_voxels}})};
}

RendererChoice renderer_named(const std::string& renderer) {
    return one_of<RendererChoice>(renderer, "renderer",
                                  {{"raycast", RendererChoice::raycast}, {"slices", RendererChoice::slices}});
}

glm::ivec2 size_of(const std::pair<int, int>& size_px) {
    if (size_px.first < 16 || size_px.second < 16 || size_px.first > 4096 || size_px.second > 4096)
        throw std::invalid_argument("size_px: takes 16 to 4096 pixels either way");
    return {size_px.first, size_px.second};
}

std::vector<TissueColour> tissues_of(const LoadedCase& loaded) {
    return tissue_colours(loaded.settings().tissues);
}

std::unique_ptr<PictureTrial> trial(const LoadedCase& loaded, const std::string& view,
                                    const std::string& shading, const std::pair<int, int>& size_px,
                                    bool smoothed_normals) {
    const glm::ivec2 size = size_of(size_px);
    const ShadingSettings look = look_named(shading);
    const bool is_close = one_of<bool>(view, "view", {{"overview", false}, {"close-up", true}});
    const py::gil_scoped_release released;
    const Bone& bone = loaded.scene().bone;
    Camera camera = study::overview_of(bone);
    if (is_close) camera = study::close_up_of(bone, camera, close_up_radius_mm);
    return std::make_unique<PictureTrial>(bone, tissues_of(loaded), look, camera, size, smoothed_normals);
}

double frame_ms(const Bone& bone, const std::vector<TissueColour>& tissues, const std::string& shading,
                const std::string& renderer, const std::pair<int, int>& size_px, int times) {
    const study::DrawingWay way{.renderer = renderer_named(renderer)};
    const ShadingSettings look = look_named(shading);
    const glm::ivec2 size = size_of(size_px);
    const py::gil_scoped_release released;
    return study::frame_cost(bone, tissues, look, size, way, times).wall_ms;
}

py::dict draw(const PictureTrial& trial, const std::string& renderer, float step_voxels, bool skips,
              int divisor, int times) {
    if (!(step_voxels > 0.0F) || divisor < 1 || divisor > 16 || times < 0)
        throw std::invalid_argument("step_voxels is above 0, divisor is 1 to 16, times is 0 or more");
    const RendererChoice choice = renderer_named(renderer);
    DrawnWay drawn;
    {
        const py::gil_scoped_release released;
        drawn = trial.draw({choice, step_voxels, skips, divisor}, times);
    }
    py::dict told;
    told["frame_ms"] = drawn.frame.wall_ms;
    told["frame_cpu_ms"] = drawn.frame.cpu_ms;
    told["psnr_db"] = drawn.psnr_db;
    told["ssim"] = drawn.ssim;
    return told;
}

py::dict cue(const PictureTrial& trial, const std::string& name, int pairs) {
    if (pairs < 1) throw std::invalid_argument("pairs is 1 or more");
    study::CueCost cost;
    {
        const py::gil_scoped_release released;
        cost = trial.cue(name, pairs);
    }
    py::dict told;
    told["without_ms"] = cost.without_ms;
    told["with_ms"] = cost.with_ms;
    told["part_of_frame"] = cost.part_of_frame;
    told["part_of_cpu"] = cost.part_of_cpu;
    told["changed_pixels"] = cost.changed_pixels;
    return told;
}

py::dict silhouettes(const PictureTrial& trial) {
    study::SilhouettePsnr psnr;
    {
        const py::gil_scoped_release released;
        psnr = trial.silhouettes();
    }
    py::dict told;
    told["without_db"] = psnr.without_db;
    told["with_db"] = psnr.with_db;
    told["pixels"] = psnr.pixels;
    return told;
}

}  // namespace

void bind_pictures(py::module_& module) {
    py::class_<PictureTrial>(module, "PictureTrial",
                             "A view of a case's bone in one look, beside its reference image.")
        .def(py::init(&trial), py::arg("case"), py::kw_only(), py::arg("view") = "overview",
             py::arg("shading") = "gradient", py::arg("size_px") = std::pair(640, 480),
             py::arg("smoothed_normals") = true,
             "view: overview, close-up; shading: gradient, surface-voxels.")
        .def("draw", &draw, py::kw_only(), py::arg("renderer") = "raycast", py::arg("step_voxels") = 0.5F,
             py::arg("skips") = true, py::arg("divisor") = 1, py::arg("times") = 5,
             "The median of so many frames; with 0 the first is what counts. renderer: raycast, slices.")
        .def("cue", &cue, py::arg("name"), py::kw_only(), py::arg("pairs") = 5,
             "Frames with a cue of the usual look and without it, in turns. name: ambient occlusion, thin "
             "bone, smooth silhouettes, wet bone, grain, sawn faces, handpiece, motion blur.")
        .def("silhouettes", &silhouettes,
             "PSNR on silhouettes, smoothed and not, against a picture of 4 x 4 rays a pixel.")
        .def_property_readonly("has_smoothed_normals", &PictureTrial::has_smoothed_normals)
        .def_property_readonly("gl_renderer", &PictureTrial::gl_renderer);
    constexpr const char* about =
        "The time of an overview alone: the median of so many frames, with 0 the first.";
    module.def(
        "frame_ms",
        [](const LoadedCase& loaded, const std::string& shading, const std::string& renderer,
           const std::pair<int, int>& size_px, int times) {
            return frame_ms(loaded.scene().bone, tissues_of(loaded), shading, renderer, size_px, times);
        },
        py::arg("case"), py::kw_only(), py::arg("shading") = "gradient", py::arg("renderer") = "raycast",
        py::arg("size_px") = std::pair(640, 480), py::arg("times") = 5, about);
    module.def(
        "frame_ms",
        [](const Bone& block, const std::string& shading, const std::string& renderer,
           const std::pair<int, int>& size_px,
           int times) { return frame_ms(block, {}, shading, renderer, size_px, times); },
        py::arg("block"), py::kw_only(), py::arg("shading") = "gradient", py::arg("renderer") = "raycast",
        py::arg("size_px") = std::pair(640, 480), py::arg("times") = 5, about);
}

}  // namespace osteomill::python
