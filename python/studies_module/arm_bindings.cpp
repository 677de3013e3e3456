// Arms: the force on a simulated hand of any strength on an arm of any make, and the share of a swinging
// force that a coupling's spring passes.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/module/arrays.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"
#include "studies/arms/force_response.h"
#include "studies/arms/hand_on_arm.h"

namespace osteomill::python {

namespace {

py::array_t<double> forces_of(const LoadedCase& loaded, const ArmModel& arm,
                              const std::array<double, 3>& hand, const std::string& coupling,
                              const std::string& force_model, double milling_rate_hz,
                              std::optional<double> stiffness_n_per_mm, double longest_s) {
    study::HandOnArm choice{.arm = arm,
                            .coupling = coupling,
                            .force_model = force_model,
                            .milling_rate_hz = milling_rate_hz,
                            .stiffness_n_per_mm = stiffness_n_per_mm,
                            .longest_s = longest_s};
    choice.hand.mass_kg = hand[0];
    choice.hand.stiffness_n_per_mm = hand[1];
    choice.hand.damping_n_s_per_mm = hand[2];
    std::vector<glm::dvec3> forces_n;
    {
        const py::gil_scoped_release released;
        forces_n = study::forces_of(loaded.settings(), loaded.scene().bone, choice);
    }
    py::array_t<double> all({static_cast<py::ssize_t>(forces_n.size()), py::ssize_t{3}});
    for (std::size_t i = 0; i < forces_n.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            *all.mutable_data(static_cast<py::ssize_t>(i), axis) = forces_n[i][axis];
    return all;
}

}  // namespace

void bind_arms(py::module_& module) {
    // Registered for this module alone: the core registers it as osteomill.Arm.
    py::class_<ArmModel>(module, "ArmModel", py::module_local(),
                         "The make of an arm; what is left out is the simulated arm's.")
        .def(py::init([](double coulomb_friction_n, double resolution_mm) {
                 return ArmModel{.coulomb_friction_n = coulomb_friction_n, .resolution_mm = resolution_mm};
             }),
             py::kw_only(), py::arg("coulomb_friction_n") = ArmModel{}.coulomb_friction_n,
             py::arg("resolution_mm") = ArmModel{}.resolution_mm)
        .def_readonly("resolution_mm", &ArmModel::resolution_mm)
        .def_property_readonly(
            "stiffness_n_per_mm", [](const ArmModel& arm) { return limits_of(arm).max_stiffness_n_per_mm; },
            "Stiffness of the spring that the arm gets.")
        .def_property_readonly(
            "limited_by",
            [](const ArmModel& arm) { return std::string(limits_of(arm).stiffness_is_limited_by); },
            "Its stiffness, and the reason if it is less than the arm claims.");
    module.def("shipped_arms", &study::shipped_arms, "Name and make of each.");
    module.def("forces_on_hand", &forces_of, py::arg("case"), py::arg("arm"), py::kw_only(),
               py::arg("hand") = std::array{0.5, 0.3, 0.005}, py::arg("coupling") = "implicit",
               py::arg("force_model") = "milling", py::arg("milling_rate_hz") = 1000.0,
               py::arg("stiffness_n_per_mm") = py::none(), py::arg("longest_s") = 60.0,
               "A hand (kg, N/mm, N s/mm) follows the case's trajectory: the force on it each millisecond, N "
               "(n, 3), up to the trajectory's end or until the safety monitor lets go.");
    module.def(
        "force_response",
        [](const std::string& coupling, double stiffness_n_per_mm, double hz) {
            study::ForceResponse found;
            {
                const py::gil_scoped_release released;
                found = study::respond(coupling, stiffness_n_per_mm, hz);
            }
            return std::pair(found.response, found.rigid_n_s_per_m);
        },
        py::arg("coupling"), py::arg("stiffness_n_per_mm"), py::arg("hz"),
        "The response in a slot whose feed swings: the force on the hand over that of a burr that is the "
        "hand, complex, "
        "and "
        "N s/m of the latter.");
}

}  // namespace osteomill::python
