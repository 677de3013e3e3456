// Parts of the module _studies, each in its file.
#pragma once

#include <pybind11/pybind11.h>

namespace osteomill::python {

void bind_arms(pybind11::module_& module);
void bind_calibration(pybind11::module_& module);
void bind_texts(pybind11::module_& module);
void bind_files(pybind11::module_& module);
void bind_scenes(pybind11::module_& module);
void bind_sessions(pybind11::module_& module);
void bind_forces(pybind11::module_& module);
void bind_stability(pybind11::module_& module);
void bind_states(pybind11::module_& module);
void bind_polishing(pybind11::module_& module);
void bind_real_time(pybind11::module_& module);
void bind_bridge(pybind11::module_& module);
void bind_links(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_rendering(pybind11::module_& module);

}  // namespace osteomill::python
