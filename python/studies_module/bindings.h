// Parts of the module _studies, each in its file.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>

#include "common/text/foreign_text.h"

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

/// Errors for Python, which accepts only UTF-8: a path may not be UTF-8.
/// The result of `work`. Throws std::runtime_error, printable, for whatever `work` throws.
template <typename Work>
auto with_printable_error(Work&& work) {
    try {
        return work();
    } catch (const std::exception& error) {
        throw std::runtime_error(printable(error.what()));
    }
}

}  // namespace osteomill::python
