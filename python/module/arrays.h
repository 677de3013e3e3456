// Arrays and arguments of Python, as all bindings use them.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/patient_space.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

namespace py = pybind11;

/// An array that takes over the values: nothing is copied, and it owns them.
template <typename Value>
py::array_t<Value> array_of(std::vector<Value>&& values, std::vector<py::ssize_t> shape) {
    auto kept = std::make_unique<std::vector<Value>>(std::move(values));
    const Value* data = kept->data();
    const py::capsule owner(kept.get(), [](void* it) { delete static_cast<std::vector<Value>*>(it); });
    (void)kept.release();
    return py::array_t<Value>(std::move(shape), data, owner);
}

/// (3,), a copy.
inline py::array_t<double> array_of(const glm::dvec3& v) {
    py::array_t<double> array(3);
    for (int i = 0; i < 3; ++i) array.mutable_data()[i] = v[i];
    return array;
}

/// Three finite numbers. Throws std::invalid_argument that names the argument.
inline glm::dvec3 vector_of(const py::handle& value, const char* argument) {
    const auto refuse = [&] {
        throw std::invalid_argument(std::string(argument) + ": takes three finite numbers, not " +
                                    std::string(py::repr(value)));
    };
    const py::object items = py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), ""));
    if (!items || PySequence_Fast_GET_SIZE(items.ptr()) != 3) {
        PyErr_Clear();
        refuse();
    }
    glm::dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) v[i] = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(items.ptr(), i));
    if (PyErr_Occurred() != nullptr || !is_finite(v)) {
        PyErr_Clear();
        refuse();
    }
    return v;
}

/// The axis scaled to length 1; one of length 1 stays as it is, to the bit. Throws std::invalid_argument for
/// no length.
inline glm::dvec3 unit(const glm::dvec3& axis, const char* argument) {
    const double length = glm::length(axis);
    if (!(length > 1e-9))
        throw std::invalid_argument(std::string(argument) + ": an axis of length 0 points nowhere");
    return is_of_unit_length(length) ? axis : axis / length;
}

/// Waits, without the interpreter's lock, for the thread that holds the mutex.
inline std::unique_lock<std::mutex> waited(std::mutex& busy) {
    const ReleasedLock released;
    return std::unique_lock<std::mutex>(busy);
}

/// Holds a session for one thread. Throws std::runtime_error if another thread holds it.
inline std::unique_lock<std::mutex> taken(std::mutex& busy) {
    std::unique_lock<std::mutex> lock(busy, std::try_to_lock);
    if (!lock.owns_lock())
        throw std::runtime_error(
            "the session is at work in another thread; give each thread a session of its own");
    return lock;
}

}  // namespace osteomill::python
