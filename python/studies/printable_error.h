// Errors for Python, which takes none whose text is not UTF-8: a path may be none.
#pragma once

#include <exception>
#include <stdexcept>

#include "common/text/plain_text.h"

namespace osteomill::python {

/// What `work` gives. Throws std::runtime_error, printable, for whatever it throws.
template <typename Work>
auto with_printable_error(Work&& work) {
    try {
        return work();
    } catch (const std::exception& error) {
        throw std::runtime_error(printable(error.what()));
    }
}

}  // namespace osteomill::python
