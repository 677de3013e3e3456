// The analytical reference force in Python.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <string>

#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/python_bone.h"
#include "simulation/cutting_force/reference_force.h"

namespace osteomill::python {

namespace {

using study::BoneFunction;
using study::SteadyMotion;

SteadyMotion make_motion(const py::object& position_mm, const py::object& velocity_mm_per_s,
                         const py::object& axis) {
    return {.burr = {},
            .position_mm = vector_of(position_mm, "position_mm"),
            .spindle_axis = unit(vector_of(axis, "axis"), "axis"),
            .velocity_mm_per_s = vector_of(velocity_mm_per_s, "velocity_mm_per_s")};
}

/// Stiffness of the voxel in which a point lies, times the fraction left of it.
BoneFunction function_of(const PythonBone& view) {
    return [&bone = view.bone()](const glm::dvec3& position_mm) {
        const glm::ivec3 voxel(glm::floor(to_voxel_coordinates(bone.grid(), position_mm) + 0.5));
        return bone.stiffness_at(voxel) * bone.fraction_at(voxel) / 255.0;
    };
}

BoneFunction function_of(const py::object& bone) {
    if (py::isinstance<PythonBone>(bone)) return function_of(bone.cast<const PythonBone&>());
    if (py::isinstance<py::str>(bone) && bone.cast<std::string>() == "flat") return study::flat_bone();
    if (PyCallable_Check(bone.ptr()) == 0)
        throw std::invalid_argument(
            "bone: takes a Bone, \"flat\", or a function of x, y, z (mm) that returns a relative stiffness");
    return [bone](const glm::dvec3& p) { return bone(p.x, p.y, p.z).cast<double>(); };
}

py::array_t<double> reference_force(const Burr& burr, SteadyMotion motion, const py::object& bone) {
    motion.burr = burr;
    return array_of(study::mean_reference_force_n(motion, function_of(bone)));
}

}  // namespace

void bind_reference_force(py::module_& module) {
    py::class_<SteadyMotion>(module, "Motion", "Where a burr is, and how it moves on steadily; patient LPS.")
        .def(py::init(&make_motion), py::arg("position_mm"), py::arg("velocity_mm_per_s"),
             py::arg("axis") = py::make_tuple(0.0, 0.0, 1.0),
             "position_mm (3,): the burr's centre. velocity_mm_per_s (3,). axis (3,): of the spindle, from "
             "tip to shank, of any length.")
        .def_property_readonly("position_mm",
                               [](const SteadyMotion& motion) { return array_of(motion.position_mm); })
        .def_property_readonly("velocity_mm_per_s",
                               [](const SteadyMotion& motion) { return array_of(motion.velocity_mm_per_s); })
        .def_property_readonly("axis",
                               [](const SteadyMotion& motion) { return array_of(motion.spindle_axis); });
    module.def("reference_force", &reference_force, py::arg("burr"), py::arg("motion"),
               py::arg("bone") = "flat",
               R"(Analytical force of the bone on the burr, mean over a tooth period: (3,), N, patient LPS.

The published model without voxels' steps: chips of the thickness that the feed per tooth leaves, where the burr's surface lies in bone and faces
the motion. burr: a Burr. motion: a Motion. bone: "flat" (relative stiffness 1 at and below z = 0), a function of x, y, z in mm
that returns the relative stiffness there, 0 where there is none (130 000 calls), or a Bone, whose voxels make the surface
rough by half a voxel. It asks for the bone on the burr's surface only.)");
}

}  // namespace osteomill::python
