#include "studies/stability/map/sweep.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "studies/stability/map/map_text.h"

namespace osteomill::study {

namespace {

MapOutcome run_named(const MapCase& c, const RunCase& run) {
    try {
        return run(c);
    } catch (const std::exception& error) {
        throw std::runtime_error("case '" + text_of(c) + "': " + error.what());
    }
}

}  // namespace

void sweep(const std::vector<MapPoint>& points, const std::vector<std::size_t>& indices, int jobs,
           const RunCase& run, const CaseDone& done) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> is_over{false};
    std::mutex one_at_a_time;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t i = next++; i < indices.size() && !is_over; i = next++) {
            try {
                const MapOutcome outcome = run_named(points[indices[i]].run, run);
                const std::lock_guard guard(one_at_a_time);
                if (!is_over) done(indices[i], outcome);
            } catch (...) {
                const std::lock_guard guard(one_at_a_time);
                if (!failure) failure = std::current_exception();
                is_over = true;
            }
        }
    };
    {
        std::vector<std::jthread> workers;
        for (int i = 0; i < std::max(1, jobs); ++i) workers.emplace_back(work);
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace osteomill::study
