// The module osteomill._render: frames of an image set as arrays. Separate from the core, which has no
// OpenGL; osteomill.render loads it when it is called.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene_file.h"
#include "python/module/arrays.h"
#include "python/module/exceptions.h"
#include "python/module/released_lock.h"
#include "python/render/live_view.h"
#include "python/render/rendering.h"
#include "render_client/dataset/dataset_index.h"
#include "render_client/dataset/image_files.h"

namespace osteomill::python {

namespace {

using Json = nlohmann::ordered_json;

/// The arrays of one camera, by kind as in the files' names.
py::dict arrays_of(CameraImages&& images, const DatasetImages& wanted) {
    const py::ssize_t width = images.pinhole.size_px.x, height = images.pinhole.size_px.y;
    const std::vector<py::ssize_t> flat{height, width}, deep{height, width, 3};
    py::dict arrays;
    if (wanted.colour) arrays["colour"] = array_of(std::move(images.colour.rgb), deep);
    if (wanted.ray_depth) arrays["ray_depth"] = array_of(along_rays(images.surface, images.pinhole), flat);
    if (wanted.depth) arrays["depth"] = array_of(std::move(images.surface.depth_mm), flat);
    if (wanted.labels) arrays["labels"] = array_of(std::move(images.labels), flat);
    if (wanted.normals)
        arrays["normals"] = array_of(halves_of(images.surface.normal), deep).attr("view")("float16");
    return arrays;
}

py::object from_json(const Json& json) {
    // Names may come from a hostile file.
    return py::module_::import("json").attr("loads")(
        json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

DatasetContents contents_of(const std::string& cameras, const std::string& cameras_text,
                            const std::vector<std::string>& images, std::optional<std::uint64_t> randomise) {
    return {.cameras = cameras_text.empty() ? cameras_named(cameras)
                                            : parse_cameras(cameras_text, "cameras", std::filesystem::path()),
            .images = images_named(images),
            .randomise = randomise,
            .look = usual_look(randomise.has_value())};
}

std::unique_ptr<Rendering> begin(std::filesystem::path recording, const std::string& cameras,
                                 const std::string& cameras_text, std::optional<double> fps, double from_s,
                                 const std::vector<std::string>& images,
                                 std::optional<std::uint64_t> randomise) {
    if (fps && !(*fps >= 0.001 && *fps <= 1000.0))
        throw std::invalid_argument(fmt::format("fps: takes 0.001 to 1000 frames a second, not {}", *fps));
    if (!(from_s >= 0.0))
        throw std::invalid_argument(fmt::format("from_s: takes seconds from 0 on, not {}", from_s));
    const ReleasedLock released;
    try {
        DatasetContents contents = contents_of(cameras, cameras_text, images, randomise);
        contents.from_s = from_s;
        contents.frames_per_s = fps;
        return std::make_unique<Rendering>(std::move(recording), std::move(contents));
    } catch (const SceneError& wrong) {
        throw std::invalid_argument(wrong.what());
    }
}

/// Instant, views and arrays.
py::dict dict_of(Rendering::Frame&& frame, const DatasetImages& images) {
    py::list views;
    for (std::size_t i = 0; i < frame.views.size(); ++i) {
        const py::dict view = from_json(frame.views[i]);
        view.attr("update")(arrays_of(std::move(frame.drawn.images[i]), images));
        views.append(view);
    }
    py::dict instant = from_json(frame.instant);
    instant["images"] = views;
    return instant;
}

/// The next frame; None at the end.
py::object next(Rendering& rendering) {
    std::optional<Rendering::Frame> frame;
    {
        const ReleasedLock released;
        frame = rendering.next([] {
            const py::gil_scoped_acquire acquired;
            return PyErr_CheckSignals() != 0;
        });
    }
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (!frame) return py::none();
    return dict_of(*std::move(frame), rendering.images());
}

std::unique_ptr<LiveView> make_view(const std::shared_ptr<SteppedSession>& session,
                                    const std::string& cameras, const std::string& cameras_text,
                                    const std::vector<std::string>& images,
                                    std::optional<std::uint64_t> randomise) {
    const ReleasedLock released;
    const std::unique_lock<std::mutex> held = taken(session->busy());
    try {
        return std::make_unique<LiveView>(*session, contents_of(cameras, cameras_text, images, randomise));
    } catch (const SceneError& wrong) {
        throw std::invalid_argument(wrong.what());
    }
}

py::object draw(LiveView& view, const std::shared_ptr<SteppedSession>& session) {
    std::optional<Rendering::Frame> frame;
    {
        const ReleasedLock released;
        const std::unique_lock<std::mutex> held = taken(session->busy());
        frame = view.draw(*session);
    }
    return dict_of(*std::move(frame), view.images());
}

template <typename Drawing>
py::object cameras(const Drawing& drawing) {
    Json all = Json::array();
    for (const DatasetCamera& camera : drawing.cameras()) all.push_back(json_of(camera));
    return from_json(all);
}

/// Waits for a thread that draws; the interpreter does not.
struct Unhurried {
    template <typename Drawing>
    void operator()(Drawing* drawing) const {
        const ReleasedLock released;
        delete drawing;
    }
};

}  // namespace

}  // namespace osteomill::python

PYBIND11_MODULE(_render, module) {
    namespace py = pybind11;
    using namespace osteomill::python;
    py::module_::import("osteomill._core");
    py::register_local_exception_translator(&translate);
    watch_for_exit();
    module.doc() = "Frames of image sets; use it through osteomill.render.";
    py::class_<Rendering, std::unique_ptr<Rendering, Unhurried>>(module, "Rendering")
        .def(py::init([](std::filesystem::path recording, const std::string& named, const std::string& text,
                         std::optional<double> fps, double from_s, const std::vector<std::string>& images,
                         std::optional<std::uint64_t> randomise) {
                 return begin(std::move(recording), named, text, fps, from_s, images, randomise).release();
             }),
             py::arg("recording"), py::arg("cameras"), py::arg("cameras_text"), py::arg("fps"),
             py::arg("from_s"), py::arg("images"), py::arg("randomise"))
        .def("next", &next)
        .def_property_readonly("cameras", &cameras<Rendering>)
        .def_property_readonly("sessions",
                               [](Rendering& rendering) { return from_json(rendering.sessions()); });
    py::class_<LiveView, std::unique_ptr<LiveView, Unhurried>>(module, "View")
        .def(py::init([](const std::shared_ptr<SteppedSession>& session, const std::string& named,
                         const std::string& text, const std::vector<std::string>& images,
                         std::optional<std::uint64_t> randomise) {
                 return make_view(session, named, text, images, randomise).release();
             }),
             py::arg("session"), py::arg("cameras"), py::arg("cameras_text"), py::arg("images"),
             py::arg("randomise"))
        .def("draw", &draw, py::arg("session"))
        .def_property_readonly("cameras", &cameras<LiveView>)
        .def_property_readonly("session", [](const LiveView& view) { return from_json(view.session()); });
}
