// Parts of the module, each in its file.
#pragma once

#include <pybind11/pybind11.h>

namespace osteomill::python {

void bind_arm(pybind11::module_& module);
void bind_bone(pybind11::module_& module);
void bind_case(pybind11::module_& module);
void bind_session(pybind11::module_& module);
void bind_state(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_reference_force(pybind11::module_& module);

}  // namespace osteomill::python
