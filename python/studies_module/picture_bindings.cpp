// Pictures, offscreen: the time of a frame in any way of drawing, and its error against the reference image.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/module/arrays.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"
#include "studies/render/picture_trial.h"

namespace osteomill::python {

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
