// Work without the interpreter's lock, in a thread that may be a daemon.
//
// Once the interpreter ends, a thread that requests its lock is ended by pthread_exit, which C++ turns into
// std::terminate: the whole process would abort, and other threads' recordings would stay unfinished. Such a
// thread sleeps instead, until the process is gone, as in Python 3.14.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <thread>

namespace osteomill::python {

/// The thread that ends the interpreter, once it does; of each module of the package its own.
inline std::atomic<std::thread::id> ends_interpreter{};

/// Call it when a module is made.
inline void watch_for_exit() {
    pybind11::module_::import("atexit").attr("register")(
        pybind11::cpp_function([] { ends_interpreter.store(std::this_thread::get_id()); }));
}

class ReleasedLock {
  public:
    ReleasedLock() : state_(PyEval_SaveThread()) {}
    ~ReleasedLock() {
        const std::thread::id ending = ends_interpreter.load();
        while (ending != std::thread::id() && ending != std::this_thread::get_id()) ::pause();
        PyEval_RestoreThread(state_);
    }
    ReleasedLock(const ReleasedLock&) = delete;
    ReleasedLock& operator=(const ReleasedLock&) = delete;

  private:
    PyThreadState* state_;
};

}  // namespace osteomill::python
