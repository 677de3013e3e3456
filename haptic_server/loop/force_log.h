// The recording of forces and depth as CSV, one line a haptic tick. The haptic loop only queues; somebody
// else writes.
//
// Columns: t_s; hand_*_mm and burr_*_mm, patient LPS; force_*_n, on the hand, patient axes; depth_mm, of the
// burr's lowest point below where it first met bone, along the spindle axis of that moment, 0 before;
// removed_mm3 since the start; spindle 0 or 1; fault, the number of a Fault, 0 while all is well.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "haptic_server/loop/exchange.h"

namespace osteomill {

struct ForceSample {
    double time_s = 0.0;
    glm::dvec3 hand_mm{0.0};
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 force_n{0.0};
    double depth_mm = 0.0;
    double removed_mm3 = 0.0;
    bool spindle_on = false;
    Fault fault = Fault::none;
};

class ForceLog {
  public:
    /// Room for 8 s of ticks between two drains.
    static constexpr std::size_t capacity = 8192;

    /// Creates the file and writes the header line. Throws std::runtime_error with one line naming the file.
    explicit ForceLog(const std::filesystem::path& file);

    /// Haptic loop only. When the queue is full the sample is dropped and counted. Real-time safe.
    void push(const ForceSample& sample) noexcept;
    /// Any one other thread: writes what is queued. After a failed write (a full disk) nothing more is
    /// written and error() says why.
    void drain();
    /// Writes what is left and closes the file; what the system could not store shows here at the latest.
    void close();

    std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
    /// One line, empty while all is well.
    const std::string& error() const { return error_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void fail();

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    boost::lockfree::spsc_queue<ForceSample> queue_;
    std::atomic<std::uint64_t> dropped_{0};
    std::string error_;
};

}  // namespace osteomill
