// Errors for Python, which accepts only UTF-8: a path may not be UTF-8.
#pragma once

#include <exception>
#include <stdexcept>

#include "common/text/plain_text.h"

namespace osteomill::python {

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
