// Couplings: the cases of the stability map beside the truth in continuous time, and what a tick takes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "python/studies/bindings.h"
#include "studies/stability/map/map_points.h"
#include "studies/stability/scene/map_run.h"
#include "studies/stability/scene/timed_coupling.h"

namespace osteomill::python {

namespace py = pybind11;

namespace {

using study::MapCase;
using study::MapOutcome;

/// Those of the map itself, on an ideal device.
std::vector<MapCase> map_cases(const std::string& method, bool quick) {
    std::vector<MapCase> cases;
    for (const study::MapPoint& point : study::map_points({.quick = quick, .methods = {method}}))
        if (point.part == study::MapPart::map) cases.push_back(point.run);
    return cases;
}

}  // namespace

void bind_couplings(py::module_& module) {
    py::class_<MapCase>(module, "MapCase", "A point of the stability map.")
        .def_property_readonly("is_cutting",
                               [](const MapCase& c) { return c.scene == study::MapScene::cutting; })
        .def_readonly("milling_rate_hz", &MapCase::milling_rate_hz)
        .def_readonly("delay_ticks", &MapCase::delay_ticks);
    py::class_<MapOutcome>(module, "MapOutcome", "What running it gave.")
        .def_readonly("is_stable", &MapOutcome::is_stable)
        .def_readonly("truth_mean_n", &MapOutcome::truth_mean_n)
        .def_readonly("rms_error_n", &MapOutcome::rms_error_n);
    py::class_<study::SceneCache>(module, "SceneCache", "Bones and truths that cases share.")
        .def(py::init<>());
    module.def("map_methods", &study::map_methods, "The couplings that the map compares.");
    module.def("map_cases", &map_cases, py::arg("method"), py::arg("quick"), "Its points of the map.");
    module.def(
        "run_map_case",
        [](const MapCase& c, study::SceneCache& cache) { return study::run_map_case(c, cache); },
        py::arg("case"), py::arg("cache"), py::call_guard<py::gil_scoped_release>());
    module.def("coupling_tick_us", &study::coupling_tick_us, py::arg("method"), py::arg("ticks"),
               py::call_guard<py::gil_scoped_release>(),
               "Microseconds of each tick of a hand that leads a burr along a slot.");
}

}  // namespace osteomill::python
