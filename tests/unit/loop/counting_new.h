// A program that links counting_new.cpp counts its allocations.
#pragma once

#include <cstddef>

namespace osteomill::testing {

/// Calls of operator new so far, on all threads.
std::size_t allocation_count();

}  // namespace osteomill::testing
