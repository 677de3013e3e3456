// Properties of a case for studies alone: its scene as text, the kind of a burr.
#include <pybind11/pybind11.h>

#include "common/scene/scene_file.h"
#include "python/module/loaded_case.h"
#include "python/studies_module/bindings.h"

namespace osteomill::python {

void bind_scenes(pybind11::module_& module) {
    namespace py = pybind11;
    module.def(
        "scene_text", [](const LoadedCase& loaded) { return write_scene(loaded.settings()); },
        py::arg("case"), "The scene of a case as a scene file has it.");
    module.def(
        "is_ball", [](const Burr& burr) { return burr.is_ball(); }, py::arg("burr"));
    module.def(
        "chips_alone",
        [](Burr burr) {
            burr.edge_coefficients_n_per_mm = glm::dvec3(0.0);
            return burr;
        },
        py::arg("burr"), "The burr without the force of its edges, as the model `published` takes it.");
}

}  // namespace osteomill::python
