// The published polishing experiment: a slide of the simulated hand over a cube of bone.
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include "python/module/arrays.h"
#include "python/studies_module/bindings.h"
#include "studies/polishing/polishing_slide.h"

namespace osteomill::python {

using study::PolishingSlide;

void bind_polishing(py::module_& module) {
    py::class_<PolishingSlide>(module, "PolishingSlide", "The polishing experiment of a 5 mm burr.")
        .def(py::init([](const py::handle& edges, double rpm, double stroke_mm) {
                 return PolishingSlide(vector_of(edges, "edge_coefficients_n_per_mm"), rpm, stroke_mm);
             }),
             py::arg("edge_coefficients_n_per_mm"), py::arg("rpm") = 80'000.0, py::arg("stroke_mm") = 8.0)
        .def_property_readonly(
            "start_mm", [](const PolishingSlide& slide) { return array_of(slide.start_mm()); },
            "Where it begins, on the bone's surface: (3,).")
        .def_property_readonly("burr_radius_mm", &PolishingSlide::burr_radius_mm)
        .def_property_readonly("meant_s", &PolishingSlide::meant_s,
                               "Duration of the motion that the hand intends.")
        .def(
            "meant_mm",
            [](const PolishingSlide& slide, double time_s) { return array_of(slide.meant_mm(time_s)); },
            py::arg("time_s"), "Where the hand means the burr's centre to be: (3,).")
        .def(
            "run",
            [](const PolishingSlide& slide, const std::string& force_model, const std::string& coupling,
               double milling_rate_hz, const std::filesystem::path& log) {
                study::SlideEnd end;
                {
                    const py::gil_scoped_release released;
                    end = slide.run({force_model, coupling, milling_rate_hz}, log);
                }
                return py::make_tuple(end.reached_end, end.faults);
            },
            py::arg("force_model"), py::arg("coupling"), py::arg("milling_rate_hz"), py::arg("log"),
            "Slides in a firm hand, as a session of the simulator, whose log of forces is left in a file: "
            "whether the hand came to its end, and how often a fault turned the force off.");
}

}  // namespace osteomill::python
