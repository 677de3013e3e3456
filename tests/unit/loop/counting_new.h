// A program that links counting_new.cpp counts its allocations.
#pragma once

#include <cstddef>

namespace osteomill::testing {

/// Calls of operator new so far, on all threads.
std::size_t allocation_count();
/// The same, of this thread.
std::size_t allocation_count_here();

}  // namespace osteomill::testing
