// The module osteomill._core: thin bindings over a session's assembly, the bone, recordings and the reference
// force.
#include "python/module/bindings.h"
#include "python/module/exceptions.h"
#include "python/module/released_lock.h"

PYBIND11_MODULE(_core, module) {
    osteomill::python::make_exceptions(module);
    pybind11::register_local_exception_translator(&osteomill::python::translate);
    osteomill::python::watch_for_exit();
    module.doc() = "Osteomill's core; use it through the package osteomill.";
    module.attr("__version__") = OSTEOMILL_VERSION;
    osteomill::python::bind_bone(module);
    osteomill::python::bind_case(module);
    osteomill::python::bind_arm(module);
    osteomill::python::bind_session(module);
    osteomill::python::bind_recording(module);
    osteomill::python::bind_reference_force(module);
}
