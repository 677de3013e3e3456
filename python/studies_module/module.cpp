// The module osteomill._studies: the parts of the package's studies that are computed in C++, and the checks
// of texts and files that all programs share. Its interface is not promised.
#include <string>

#include "common/program/commit.h"
#include "python/studies_module/bindings.h"

PYBIND11_MODULE(_studies, module) {
    module.doc() = "Kernels of osteomill.studies; promised to nobody.";
    module.attr("VERSION") = OSTEOMILL_VERSION;
    module.attr("COMMIT") = std::string(osteomill::built_from_commit());
    module.attr("COMPILER") = __VERSION__;
    osteomill::python::bind_arms(module);
    osteomill::python::bind_calibration(module);
    osteomill::python::bind_texts(module);
    osteomill::python::bind_files(module);
    osteomill::python::bind_scenes(module);
    osteomill::python::bind_sessions(module);
    osteomill::python::bind_forces(module);
    osteomill::python::bind_stability(module);
    osteomill::python::bind_states(module);
    osteomill::python::bind_polishing(module);
    osteomill::python::bind_real_time(module);
    osteomill::python::bind_bridge(module);
    osteomill::python::bind_links(module);
    osteomill::python::bind_pictures(module);
    osteomill::python::bind_rendering(module);
}
