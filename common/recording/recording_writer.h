// Writes a recording on a thread of its own, for loops that must not wait for a disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/recording/packet_writer.h"

namespace osteomill {

/// What became of a recording.
struct RecordingReport {
    std::filesystem::path file;
    std::uint64_t frames = 0;
    std::uint64_t bytes = 0;
    std::string error{};  ///< one line; empty where all frames are in the file
};

class RecordingWriter {
  public:
    /// What may wait for the disk. A second of the fastest loopback snapshot; whoever finds it full tells
    /// later what it has to tell, as it would a slow client.
    static constexpr std::size_t capacity_bytes = 8 * 1024 * 1024;

    /// Opens the file; throws RecordingError. `on_failure` is called once, on the writing thread, with one
    /// line, when nothing more can be written.
    RecordingWriter(std::filesystem::path file, std::function<void(const std::string&)> on_failure);
    /// Closes first, if need be.
    ~RecordingWriter();
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    /// Whether push() would take a frame. Once writing has failed it takes, and forgets, every one.
    bool has_room() const;
    /// Waits until there is room: for who may wait for a disk.
    void wait_for_room() const;
    /// Waits until all that was pushed is in the file, or writing has failed.
    void wait_until_written() const;
    /// Never waits for the disk. Call only with room.
    void push(Stamp stamp, std::string message);
    bool has_failed() const;

    /// Writes what still waits, and ends the thread. What is pushed later is forgotten.
    void close();
    RecordingReport report() const;

  private:
    struct Waiting {
        Stamp stamp;
        std::string message;
    };
    void run();

    PacketWriter packets_;  // the writing thread's
    const std::function<void(const std::string&)> on_failure_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;
    bool is_closing_ = false;
    RecordingReport report_;
    std::thread thread_;
};

}  // namespace osteomill
