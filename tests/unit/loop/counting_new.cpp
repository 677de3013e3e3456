// Apart from the tests, so that the compiler cannot inline one half of a pair of new and delete.
#include "tests/unit/loop/counting_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocations{0};
thread_local std::size_t allocations_here = 0;

void count() {
    allocations.fetch_add(1, std::memory_order_relaxed);
    ++allocations_here;
}

}  // namespace

namespace osteomill::testing {

std::size_t allocation_count() {
    return allocations.load(std::memory_order_relaxed);
}
std::size_t allocation_count_here() {
    return allocations_here;
}

}  // namespace osteomill::testing

void* operator new(std::size_t size) {
    count();
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    count();
    return std::malloc(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    count();
    const auto align = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
