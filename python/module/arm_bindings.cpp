// User-defined arms in Python.
#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <stdexcept>

#include "devices/simulated/hand_and_arm.h"
#include "python/module/bindings.h"

namespace osteomill::python {

namespace py = pybind11;

namespace {

void require_within(const char* name, double value, double least, double most, const char* unit) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument(
            fmt::format("{}: takes {:g} to {:g} {}, not {:g}", name, least, most, unit, value));
}

ArmModel make_arm(double mass_kg, double stiffness_n_per_mm, double max_force_n, double friction_n,
                  double damping_n_s_per_mm, double resolution_mm, int delay_ms) {
    require_within("mass_kg", mass_kg, 0.001, 100.0, "kg");
    require_within("stiffness_n_per_mm", stiffness_n_per_mm, 0.01, 1000.0, "N/mm");
    require_within("max_force_n", max_force_n, 0.01, 1000.0, "N");
    require_within("friction_n", friction_n, 0.0, 100.0, "N");
    require_within("damping_n_s_per_mm", damping_n_s_per_mm, 0.0, 10.0, "N s/mm");
    require_within("resolution_mm", resolution_mm, 0.0, 1.0, "mm");
    require_within("delay_ms", delay_ms, 0.0, 20.0, "ms");
    return {.mass_kg = mass_kg,
            .coulomb_friction_n = friction_n,
            .damping_n_s_per_mm = damping_n_s_per_mm,
            .resolution_mm = resolution_mm,
            .max_force_n = max_force_n,
            .max_stiffness_n_per_mm = stiffness_n_per_mm,
            .delay_ms = delay_ms};
}

}  // namespace

void bind_arm(py::module_& module) {
    const ArmModel usual;
    py::class_<ArmModel>(module, "Arm",
                         R"(A haptic arm or a robot, as a session has it: Session(case, arm=...).

Force is limited to `max_force_n`. `stiffness_n_per_mm` is of the stiffest spring that it claims to render: a coupling takes that, or less
where mass, friction, encoder and delay hold no more. A simulated hand holds an arm of all these figures; a prescribed hand has
the limits that follow from them, and is read exactly. The defaults are a small haptic arm's.)")
        .def(
            py::init(&make_arm), py::kw_only(), py::arg("mass_kg") = usual.mass_kg,
            py::arg("stiffness_n_per_mm") = usual.max_stiffness_n_per_mm,
            py::arg("max_force_n") = usual.max_force_n, py::arg("friction_n") = usual.coulomb_friction_n,
            py::arg("damping_n_s_per_mm") = usual.damping_n_s_per_mm,
            py::arg("resolution_mm") = usual.resolution_mm, py::arg("delay_ms") = usual.delay_ms,
            R"(mass_kg: apparent, at the tip. friction_n: Coulomb's, static and sliding alike. damping_n_s_per_mm: viscous.
resolution_mm: of its encoder, along each axis; 0: exact. delay_ms: whole milliseconds after which a force acts, beside the tick that
it takes. BadInput: a figure is out of range.)")
        .def_property_readonly("mass_kg", [](const ArmModel& arm) { return arm.mass_kg; })
        .def_property_readonly("stiffness_n_per_mm",
                               [](const ArmModel& arm) { return arm.max_stiffness_n_per_mm; })
        .def_property_readonly("max_force_n", [](const ArmModel& arm) { return arm.max_force_n; })
        .def_property_readonly("friction_n", [](const ArmModel& arm) { return arm.coulomb_friction_n; })
        .def_property_readonly("damping_n_s_per_mm",
                               [](const ArmModel& arm) { return arm.damping_n_s_per_mm; })
        .def_property_readonly("resolution_mm", [](const ArmModel& arm) { return arm.resolution_mm; })
        .def_property_readonly("delay_ms", [](const ArmModel& arm) { return arm.delay_ms; })
        .def_property_readonly(
            "rendered_stiffness_n_per_mm",
            [](const ArmModel& arm) { return limits_of(arm).max_stiffness_n_per_mm; },
            "Stiffness of the spring that a coupling puts on the arm.")
        .def(py::pickle(
            [](const ArmModel& arm) {
                return py::make_tuple(arm.mass_kg, arm.max_stiffness_n_per_mm, arm.max_force_n,
                                      arm.coulomb_friction_n, arm.damping_n_s_per_mm, arm.resolution_mm,
                                      arm.delay_ms);
            },
            [](const py::tuple& kept) {
                return make_arm(kept[0].cast<double>(), kept[1].cast<double>(), kept[2].cast<double>(),
                                kept[3].cast<double>(), kept[4].cast<double>(), kept[5].cast<double>(),
                                kept[6].cast<int>());
            }))
        .def("__repr__", [](const ArmModel& arm) {
            return fmt::format("<Arm of {:g} kg: up to {:g} N and {:g} N/mm, {} ms late>", arm.mass_kg,
                               arm.max_force_n, arm.max_stiffness_n_per_mm, arm.delay_ms);
        });
}

}  // namespace osteomill::python
