// Recordings in Python.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "analysis/hdf5/recording_hdf5.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/session_metrics.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/bone_view.h"
#include "python/module/opened_recording.h"

namespace osteomill::python {

namespace {

using SharedRecording = std::shared_ptr<OpenedRecording>;

py::object from_json(const std::string& text) {
    return py::module_::import("json").attr("loads")(text);
}

/// A property that is a copy of a column, (N,) or (N, 3).
template <typename Value>
auto column(std::vector<Value> StateColumns::*values, int width = 1) {
    return [values, width](const SharedRecording& recording) {
        const std::unique_lock<std::mutex> held = taken(recording->busy());
        std::vector<Value> copy;
        {
            const py::gil_scoped_release released;
            copy = recording->columns().*values;
        }
        const auto n = static_cast<py::ssize_t>(copy.size()) / width;
        return array_of(std::move(copy),
                        width == 1 ? std::vector<py::ssize_t>{n} : std::vector<py::ssize_t>{n, width});
    };
}

BoneView bone_at(const SharedRecording& recording, double time_s) {
    if (!(time_s >= 0.0))
        throw std::invalid_argument(fmt::format("time_s: takes seconds from 0 on, not {}", time_s));
    const py::gil_scoped_release released;
    const std::unique_lock<std::mutex> held = taken(recording->busy());
    return BoneView(Bone(recording->bone_at(time_s)));
}

py::object metrics(const SharedRecording& recording) {
    std::string text;
    {
        const py::gil_scoped_release released;
        const SessionTrace trace = read_trace(recording->file(), [](double) {});
        text = metrics_json(trace, metric_rows(session_metrics(trace)));
    }
    return from_json(text)["metrics"];
}

py::object info(const SharedRecording& recording) {
    std::string text;
    {
        const py::gil_scoped_release released;
        const std::unique_lock<std::mutex> held = taken(recording->busy());
        // Names may be what a hostile file holds.
        text = to_json(recording->summary())
                   .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    }
    return from_json(text);
}

void to_hdf5(const SharedRecording& recording, const std::filesystem::path& file, const std::string& layout) {
    const auto* const name = std::ranges::find(hdf5_layout_names, layout);
    if (name == hdf5_layout_names.end())
        throw std::invalid_argument(
            fmt::format("layout: takes {}, not '{}'", fmt::join(hdf5_layout_names, ", "), layout));
    const py::gil_scoped_release released;
    const std::string error = write_hdf5(
        recording->file(), file, static_cast<Hdf5Layout>(name - hdf5_layout_names.begin()), [](double) {});
    if (!error.empty()) throw std::runtime_error(error);
}

}  // namespace

void bind_recording(py::module_& module) {
    py::class_<OpenedRecording, SharedRecording>(
        module, "Recording", R"(A recording of a session: its states, and its bone at any instant.

It is read through when the first array is requested. Arrays have a row a state, thirty a second; they are copies, in
patient LPS.)")
        .def(py::init([](std::filesystem::path file) {
                 return std::make_shared<OpenedRecording>(std::move(file));
             }),
             py::arg("file"),
             "Opens a file of haptic_server --record, --report (session.pcap) or Session(record=...). "
             "RuntimeError: it is none.")
        .def_property_readonly(
            "file", [](const SharedRecording& recording) { return recording->file(); },
            "The file that was opened.")
        .def_property_readonly("time_s", column(&StateColumns::time_s),
                               "Seconds since the recording began: (N,).")
        .def_property_readonly("session_time_s", column(&StateColumns::session_time_s),
                               "Time of the session: (N,).")
        .def_property_readonly("hand_mm", column(&StateColumns::hand_mm, 3), "Where the hand is: (N, 3).")
        .def_property_readonly("burr_mm", column(&StateColumns::burr_mm, 3), "Centre of the burr: (N, 3).")
        .def_property_readonly("axis", column(&StateColumns::axis, 3),
                               "Of the spindle, from tip to shank: (N, 3), unit.")
        .def_property_readonly("force_n", column(&StateColumns::force_n, 3), "On the hand: (N, 3).")
        .def_property_readonly("depth_mm", column(&StateColumns::depth_mm), "As Step.depth_mm: (N,).")
        .def_property_readonly("removed_mm3", column(&StateColumns::removed_mm3),
                               "Bone removed so far: (N,).")
        .def_property_readonly("burr", column(&StateColumns::burr), "Number of the burr: uint8 (N,).")
        .def_property_readonly(
            "spindle_on",
            [](const SharedRecording& recording) {
                return column(&StateColumns::spindle_on)(recording).attr("view")("bool");
            },
            "bool (N,).")
        .def("bone_at", &bone_at, py::arg("time_s"),
             "The bone after the last frame that is no later than `time_s`, seconds since the recording "
             "began. Ascending times cost "
             "what lies between them. RuntimeError: the file is damaged before that.")
        .def("metrics", &metrics,
             "The metrics of docs/metrics.md, by key, as metrics.json has them: a number or None; those of "
             "tissues, burrs or structures "
             "under KEY_of, by name.")
        .def("to_hdf5", &to_hdf5, py::arg("file"), py::arg("layout") = "osteomill",
             "Writes all of it into an HDF5 file (docs/hdf5.md); layout: \"osteomill\", \"fivrs\" or "
             "\"fivrs-v3\". Of a torn recording, what can be read. RuntimeError: it cannot be written, or is "
             "damaged; ValueError: no such layout.")
        .def("info", &info,
             "What packet_replay --json says: duration_s, frames, removed_mm3 by tissue, bone_checksum, "
             "error and more.")
        .def("__enter__", [](const SharedRecording& recording) { return recording; })
        .def("__exit__", [](const SharedRecording&, const py::args&) {})
        .def("__repr__", [](const SharedRecording& recording) {
            return fmt::format("<Recording {}>", recording->file().string());
        });
}

}  // namespace osteomill::python
