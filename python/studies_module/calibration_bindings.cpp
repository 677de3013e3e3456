// The mean force of a run on a dynamometer in Python: a spherical burr in steady motion over a flat specimen.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "python/module/arrays.h"
#include "python/studies_module/bindings.h"
#include "studies/force/steady_case.h"

namespace osteomill::python {

namespace {

/// Within 0.3 % of a far finer quadrature, which is finer than a dynamometer needs (tested); a table of 24
/// runs takes a fraction of a second.
constexpr study::Quadrature enough{.kappa = 120, .psi = 240};

SpindleSense sense_of(const std::string& turns) {
    if (turns == spindle_sense_names[0]) return SpindleSense::clockwise;
    if (turns == spindle_sense_names[1]) return SpindleSense::counter_clockwise;
    throw std::invalid_argument("turns: takes clockwise or counter-clockwise, not " + turns);
}

py::array_t<double> mean_slot_force_n(double diameter_mm, int edges, const std::string& turns, double rpm,
                                      double feed_mm_per_s, double depth_mm, const py::handle& axis,
                                      std::optional<double> previous_groove_mm_higher,
                                      const py::handle& cutting_n_per_mm2, const py::handle& edge_n_per_mm,
                                      int finer) {
    study::SteadyCase c;
    c.burr.diameter_mm = diameter_mm;
    c.burr.edges = edges;
    c.burr.sense = sense_of(turns);
    c.burr.spindle_rev_per_s = rpm / 60.0;
    c.burr.cutting_coefficients_n_per_mm2 = vector_of(cutting_n_per_mm2, "cutting_n_per_mm2");
    c.burr.edge_coefficients_n_per_mm = vector_of(edge_n_per_mm, "edge_n_per_mm");
    c.velocity_mm_per_s = {feed_mm_per_s, 0.0, 0.0};
    c.spindle_axis = unit(vector_of(axis, "axis"), "axis");
    c.depth_mm = depth_mm;
    c.previous_groove_mm_higher = previous_groove_mm_higher;
    return array_of(study::mean_reference_force_n(
        motion_of(c), bone_of(c), {.kappa = finer * enough.kappa, .psi = finer * enough.psi}));
}

}  // namespace

void bind_calibration(py::module_& module) {
    module.def(
        "mean_slot_force_n", &mean_slot_force_n, py::kw_only(), py::arg("diameter_mm"), py::arg("edges"),
        py::arg("turns"), py::arg("rpm"), py::arg("feed_mm_per_s"), py::arg("depth_mm"), py::arg("axis"),
        py::arg("previous_groove_mm_higher"), py::arg("cutting_n_per_mm2"), py::arg("edge_n_per_mm"),
        py::arg("finer") = 1,
        R"(Mean force of the bone on a ball that cuts a straight slot along +x into bone below z = 0: (3,), N.

axis (3,): of the spindle, from tip to shank. previous_groove_mm_higher: the same burr cut the same line before,
that much higher; None: fresh bone. finer: that many times the points of the quadrature.)");
}

}  // namespace osteomill::python
