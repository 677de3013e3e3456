// The package's own exceptions, which tell a script's own mistake from a failure.
//
// BadInput, a ValueError: an argument is wrong, and the line says what would be right. Fault, a RuntimeError:
// the request was right and failed: a file that cannot be read, a session that has ended.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>

namespace osteomill::python {

inline void raise_own(const char* name, const char* line) {
    PyErr_SetString(pybind11::module_::import("osteomill._core").attr(name).ptr(), line);
}

inline void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const pybind11::builtin_exception&) {
        throw;
    } catch (const std::invalid_argument& wrong) {
        raise_own("BadInput", wrong.what());
    } catch (const std::domain_error&) {
        throw;
    } catch (const std::length_error&) {
        throw;
    } catch (const std::out_of_range&) {
        throw;
    } catch (const std::overflow_error&) {
        throw;
    } catch (const std::range_error&) {
        throw;
    } catch (const std::logic_error& wrong) {
        raise_own("Fault", wrong.what());
    } catch (const std::runtime_error& wrong) {
        raise_own("Fault", wrong.what());
    }
}

/// Made in the core, before anything else.
inline void make_exceptions(pybind11::module_& module) {
    const auto make = [&module](const char* name, const char* whole_name, const char* doc, PyObject* base) {
        module.attr(name) = pybind11::reinterpret_steal<pybind11::object>(
            PyErr_NewExceptionWithDoc(whole_name, doc, base, nullptr));
    };
    make("BadInput", "osteomill.BadInput", "An argument is wrong; the line says what would be right.",
         PyExc_ValueError);
    make("Fault", "osteomill.Fault", "The request could not be carried out; the message gives the reason.",
         PyExc_RuntimeError);
}

}  // namespace osteomill::python
