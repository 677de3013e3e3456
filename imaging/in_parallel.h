// One piece of work for each number, on all cores.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace osteomill {

/// Calls work(0) to work(count - 1), each once, in any order, and returns when all are done. The first
/// exception that one throws is thrown again here; calls that have not begun by then are left out.
template <typename Work>
void in_parallel(int count, const Work& work) {
    std::atomic<int> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    const auto run = [&] {
        try {
            for (int i = next++; i < count; i = next++) work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    {
        const int cores = static_cast<int>(std::thread::hardware_concurrency());
        std::vector<std::jthread> helpers;
        for (int i = 1; i < cores && i < count; ++i) helpers.emplace_back(run);
        run();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace osteomill
